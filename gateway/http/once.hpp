// SPDX-License-Identifier: Apache-2.0
// A handler that is called once, whatever its type, so that the operations of Asio and Beast are compiled for
// one handler and not for each.
#pragma once

#include <boost/system/error_code.hpp>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace trunnion::gateway {

template <class... Arguments>
class Once {
 public:
  template <class Function, class = std::enable_if_t<!std::is_same_v<std::decay_t<Function>, Once>>>
  Once(Function&& function)  // NOLINT(google-explicit-constructor): it takes the place of the function
      : held_(std::make_unique<Holds<std::decay_t<Function>>>(std::forward<Function>(function))) {}

  void operator()(Arguments... arguments) {
    // Freed before it continues, as Asio asks of its handlers.
    const auto held = std::move(held_);
    held->call(std::forward<Arguments>(arguments)...);
  }

 private:
  struct Held {
    Held() = default;
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    virtual ~Held() = default;
    virtual void call(Arguments... arguments) = 0;
  };
  template <class Function>
  struct Holds : Held {
    explicit Holds(Function&& held) : function(std::move(held)) {}
    explicit Holds(const Function& held) : function(held) {}
    void call(Arguments... arguments) override { function(std::forward<Arguments>(arguments)...); }
    Function function;
  };
  std::unique_ptr<Held> held_;
};

/// Of a transfer: its error and the bytes.
using Transferred = Once<boost::system::error_code, std::size_t>;
/// Of everything else.
using Done = Once<boost::system::error_code>;

}  // namespace trunnion::gateway
