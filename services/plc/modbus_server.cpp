// SPDX-License-Identifier: Apache-2.0
// Other devices ask the PLC over Modbus TCP.
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "modbus_connection.hpp"
#include "modbus_protocol.hpp"

namespace trunnion::plc {
namespace {

using Clock = std::chrono::steady_clock;
using st::ModbusTable;

constexpr std::size_t most_clients = 8;
constexpr int most_waiting = 64;          // connections that come faster than they are taken
constexpr int most_unread = 16384;        // bytes of answers that a client has not read
constexpr int poll_period = 50;           // ms until the end of the thread is seen
constexpr std::size_t least_request = 8;  // bytes: the header of 7 and a function
constexpr double listen_period = 0.5;     // s between two attempts to listen
constexpr int silent_attempts = 3;

struct CloseServer {
  void operator()(modbus_t* context) const { modbus_free(context); }
};
struct FreeMapping {
  void operator()(modbus_mapping_t* mapping) const { modbus_mapping_free(mapping); }
};

std::uint16_t word_at(const std::uint8_t* bytes) {
  return static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]);
}

class ServerConnection : public ModbusLink::Connection {
 public:
  explicit ServerConnection(const st::ModbusServer& server)
      : Connection(server.inputs, server.outputs), server_(server) {
    for (const auto* list : {&input_blocks, &output_blocks})
      for (const auto& block : *list) {
        auto& covered = covered_[static_cast<std::size_t>(block.table)];
        covered.resize(std::max<std::size_t>(covered.size(), block.address + block.count), false);
        std::fill_n(covered.begin() + block.address, block.count, true);
      }
    const auto size = [&](ModbusTable table) {
      return static_cast<int>(covered_[static_cast<std::size_t>(table)].size());
    };
    mapping_.reset(modbus_mapping_new(size(ModbusTable::coils), size(ModbusTable::discrete_inputs),
                                      size(ModbusTable::holding_registers),
                                      size(ModbusTable::input_registers)));
  }
  ~ServerConnection() override { close_all(); }

 private:
  using Query = std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH>;
  struct Client {
    int socket = -1;
    std::string address;
    Clock::time_point heard;
    std::size_t wakes_with = 1;  ///< bytes
  };

  void run(const std::stop_token& stop) override {
    for (int attempts = 0; !stop.stop_requested();) {
      if (!listens() && !listen()) {
        // In a swap the process before holds the port for a moment.
        if (++attempts > silent_attempts)
          lost("Modbus: nothing can be received at " + server_.host + ", port " +
               std::to_string(server_.port) + ": " + modbus_strerror(errno) +
               ". Correct host and port of the server in modbus.yaml");
        if (!wait(stop, listen_period)) return;
        continue;
      }
      serve();
      const auto silence = std::chrono::duration<double>(Clock::now() - written_).count();
      if (server_.timeout > 0 && silence > server_.timeout) {
        put_losses_into_tables();
        lost("Modbus: no other device has written for " +
             std::to_string(std::lround(server_.timeout * 1000)) + " ms. The inputs " +
             registers_text(input_blocks) +
             " have their values for this case. Check the device that writes and its cable, then reset");
      } else {
        works();
      }
    }
  }

  // So that a later write of some elements does not bring back old values of others.
  void put_losses_into_tables() {
    for (const auto& block : input_blocks)
      for (std::uint32_t i = 0; block.at_loss && i < block.count; ++i)
        if (block.table == ModbusTable::coils)
          mapping_->tab_bits[block.address + i] = static_cast<std::uint8_t>(*block.at_loss);
        else
          mapping_->tab_registers[block.address + i] = *block.at_loss;
  }

  bool listens() const { return listening_ >= 0; }
  bool listen() {
    context_.reset(modbus_new_tcp_pi(server_.host.c_str(), std::to_string(server_.port).c_str()));
    if (!context_ || !mapping_) return false;
    put_losses_into_tables();
    // Also the pause behind a request that is refused.
    modbus_set_response_timeout(context_.get(), 0, 1000);
    listening_ = modbus_tcp_pi_listen(context_.get(), most_waiting);
    if (listening_ < 0) return false;
    written_ = Clock::now();
    return true;
  }

  void close_all() {
    for (const auto& client : clients_) close(client.socket);
    clients_.clear();
    if (listening_ >= 0) close(listening_);
    listening_ = -1;
  }

  void serve() {
    std::vector<pollfd> waiting = {{listening_, POLLIN, 0}};
    for (const auto& client : clients_) waiting.push_back({client.socket, POLLIN | POLLRDHUP, 0});
    if (poll(waiting.data(), waiting.size(), poll_period) <= 0) return;
    for (std::size_t i = clients_.size(); i-- > 0;) {
      const auto happened = waiting[i + 1].revents;
      if (happened != 0 && !hear(clients_[i], (happened & ~POLLIN) != 0)) end(i);
    }
    if (waiting[0].revents != 0) accept_client();
  }

  void end(std::size_t client) {
    close(clients_[client].socket);
    clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(client));
  }

  void accept_client() {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    // An answer that the client does not take is an error, which ends the connection.
    const int socket =
        accept4(listening_, reinterpret_cast<sockaddr*>(&address), &size, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (socket < 0) return;
    setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &most_unread, sizeof most_unread);
    std::array<char, NI_MAXHOST> host{};
    getnameinfo(reinterpret_cast<sockaddr*>(&address), size, host.data(), host.size(), nullptr, 0,
                NI_NUMERICHOST);
    clients_.push_back({socket, host.data(), Clock::now()});
    wake_with(clients_.back(), least_request);
    if (clients_.size() > most_clients) end(superfluous());
  }

  // Of the address with the most connections the one that has been silent for longest, as the guide
  // recommends (MODBUS Messaging on TCP/IP V1.0b, 4.2.1): one device that opens many ends its own.
  std::size_t superfluous() const {
    std::map<std::string, int> of_address;
    for (const auto& client : clients_) ++of_address[client.address];
    const auto before = [&](const Client& a, const Client& b) {
      const int many_a = of_address.at(a.address), many_b = of_address.at(b.address);
      return many_a != many_b ? many_a > many_b : a.heard < b.heard;
    };
    return static_cast<std::size_t>(std::min_element(clients_.begin(), clients_.end(), before) -
                                    clients_.begin());
  }

  // So that half of a request does not wake the thread again and again.
  static void wake_with(Client& client, std::size_t bytes) {
    if (client.wakes_with == bytes) return;
    client.wakes_with = bytes;
    const int mark = static_cast<int>(bytes);
    setsockopt(client.socket, SOL_SOCKET, SO_RCVLOWAT, &mark, sizeof mark);
  }

  // A request waits in the socket until it is whole: half of one holds up nobody. False when the connection
  // has ended, or sends what is no Modbus.
  bool hear(Client& client, bool ends) {
    Query query{};
    const auto there = recv(client.socket, query.data(), query.size(), MSG_PEEK);
    auto length = least_request;
    if (there >= static_cast<ssize_t>(length))
      length = std::clamp<std::size_t>(word_at(&query[4]) + 6u, length, query.size());
    if (there < static_cast<ssize_t>(length)) {
      wake_with(client, length);
      return !ends;
    }
    query = {};
    if (recv(client.socket, query.data(), length, 0) != static_cast<ssize_t>(length)) return false;
    client.heard = Clock::now();
    wake_with(client, least_request);
    return answer(client.socket, query, static_cast<int>(length));
  }

  bool answer(int socket, const Query& query, int length) {
    if (word_at(&query[2]) != 0 || word_at(&query[4]) + 6 != length) return false;
    modbus_set_socket(context_.get(), socket);
    refresh();
    bool writes = false;
    if (const int exception = check(query.data(), length, writes); exception != 0)
      return modbus_reply_exception(context_.get(), query.data(), static_cast<unsigned>(exception)) >= 0;
    if (modbus_reply(context_.get(), query.data(), length, mapping_.get()) < 0) return false;
    if (writes) take(query.data());
    return true;
  }

  bool covers(ModbusTable table, int address, int count) const {
    const auto& covered = covered_[static_cast<std::size_t>(table)];
    if (address < 0 || count < 1 || static_cast<std::size_t>(address + count) > covered.size()) return false;
    return std::all_of(covered.begin() + address, covered.begin() + address + count,
                       [](bool one) { return one; });
  }

  /// The exception with which the request is refused, or 0. MODBUS Application Protocol V1.1b3, 6.
  int check(const std::uint8_t* query, int length, bool& writes) const {
    const auto* data = query + 8;
    const int bytes = length - 8, function = query[7];
    const auto word = [&](int i) { return bytes >= 2 * i + 2 ? word_at(data + 2 * i) : -1; };
    const auto is_good = [&](ModbusTable table, int address, int count) {
      return count >= 1 && covers(table, address, count) ? 0 : int{MODBUS_EXCEPTION_ILLEGAL_DATA_ADDRESS};
    };
    writes = function == 5 || function == 6 || function == 15 || function == 16 || function == 22 ||
             function == 23;
    const bool has_one_length = (function >= 1 && function <= 6) || function == 22;
    if (has_one_length && bytes != (function == 22 ? 6 : 4)) return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
    switch (function) {
      case 1:
        return is_good(ModbusTable::coils, word(0), word(1));
      case 2:
        return is_good(ModbusTable::discrete_inputs, word(0), word(1));
      case 3:
        return is_good(ModbusTable::holding_registers, word(0), word(1));
      case 4:
        return is_good(ModbusTable::input_registers, word(0), word(1));
      case 5:
        return is_good(ModbusTable::coils, word(0), 1);
      case 6:
      case 22:
        return is_good(ModbusTable::holding_registers, word(0), 1);
      case 15:
        if (bytes < 5 || data[4] != (word(1) + 7) / 8 || bytes != 5 + data[4])
          return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
        return is_good(ModbusTable::coils, word(0), word(1));
      case 16:
        if (bytes < 5 || data[4] != 2 * word(1) || bytes != 5 + data[4])
          return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
        return is_good(ModbusTable::holding_registers, word(0), word(1));
      case 23:
        if (bytes < 9 || data[8] != 2 * word(3) || bytes != 9 + data[8])
          return MODBUS_EXCEPTION_ILLEGAL_DATA_VALUE;
        if (const int first = is_good(ModbusTable::holding_registers, word(0), word(1)); first != 0)
          return first;
        return is_good(ModbusTable::holding_registers, word(2), word(3));
      default:
        return MODBUS_EXCEPTION_ILLEGAL_FUNCTION;
    }
  }

  void refresh() {
    const auto values = outputs();
    for (std::size_t b = 0; b < values.size(); ++b) {
      const auto& block = output_blocks[b];
      for (std::size_t i = 0; i < values[b].size(); ++i)
        if (block.table == ModbusTable::discrete_inputs)
          mapping_->tab_input_bits[block.address + i] = static_cast<std::uint8_t>(values[b][i]);
        else
          mapping_->tab_input_registers[block.address + i] = values[b][i];
    }
  }

  // Only what was written: after a restart the other inputs stay as they were.
  void take(const std::uint8_t* query) {
    const int function = query[7];
    const bool several = function == 15 || function == 16 || function == 23;
    const auto* data = query + (function == 23 ? 12 : 8);
    const auto table = function == 5 || function == 15 ? ModbusTable::coils : ModbusTable::holding_registers;
    const std::uint32_t first = word_at(data), end = first + (several ? word_at(data + 2) : 1u);
    NetworkInputs inputs;
    for (const auto& block : input_blocks) {
      const auto from = std::max<std::uint32_t>(first, block.address);
      const auto to = std::min<std::uint32_t>(end, block.address + block.count);
      if (block.table != table || from >= to) continue;
      std::vector<std::uint16_t> values;
      for (auto i = from; i < to; ++i)
        values.push_back(table == ModbusTable::coils ? mapping_->tab_bits[i] : mapping_->tab_registers[i]);
      auto part = block;
      part.first = st::place_of(block, from - block.address);
      put_block(part, values, inputs);
    }
    give(inputs);
    written_ = Clock::now();
  }

  const st::ModbusServer server_;
  std::array<std::vector<bool>, 4> covered_;  ///< of each table
  std::unique_ptr<modbus_mapping_t, FreeMapping> mapping_;
  std::unique_ptr<modbus_t, CloseServer> context_;
  int listening_ = -1;
  std::vector<Client> clients_;
  Clock::time_point written_;
};

}  // namespace

std::unique_ptr<ModbusLink::Connection> modbus_server(const st::ModbusServer& server) {
  return std::make_unique<ServerConnection>(server);
}

}  // namespace trunnion::plc
