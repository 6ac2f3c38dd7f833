// SPDX-License-Identifier: Apache-2.0
#include "machine/axis_faults.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "canonical/axes.hpp"
#include "machine/axes.hpp"
#include "machine/gantry_pairs.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::machine {
namespace {

std::string join(std::initializer_list<std::string> parts) {
  std::string text;
  for (const auto& part : parts) text += part;
  return text;
}

// "parameter 100006 (positive_limit)"
std::string named(const ParameterKey& key, std::uint32_t unit = 0, std::uint32_t index = 0) {
  return join({"parameter ", number_text(key.number(unit, index)), " (", key.name, ")"});
}

class AxisFaults {
 public:
  explicit AxisFaults(const Parameters& p) : p_(p), axes_(drive_axes(p)), spindles_(machine::spindles(p)) {}

  std::vector<ParameterFault> find() {
    for (std::uint16_t channel = 0; channel < channel_count; ++channel) {
      letters(channel);
      spindles(channel);
    }
    gantries();
    for (const auto& axis : axes_) {
      travel(axis);
      gear(axis);
    }
    for (std::uint32_t i = 0; i < skip_inputs; ++i) skip_input(i);
    return std::move(faults_);
  }

 private:
  struct Letter {
    std::uint16_t channel = 0;
    std::uint32_t index = 0;
    std::uint32_t number() const { return parameter::channel_axis.number(channel, index); }
    std::string name() const { return std::string(1, canonical::axis_letters[index]); }
    std::string text() const { return name() + " of channel " + std::to_string(channel); }
  };
  static constexpr std::uint32_t skip_inputs = 4, numbered_references = 3;

  void add(std::vector<std::uint32_t> numbers, std::initializer_list<std::string> text) {
    faults_.push_back({std::move(numbers), join(text)});
  }

  // "axis 1 (Y)"
  std::string axis_text(int number) const {
    const auto name = number < 0 ? "" : p_.text(parameter::axis_name, static_cast<std::uint32_t>(number));
    return "axis " + std::to_string(number) + (name.empty() ? "" : " (" + name + ")");
  }

  // Why logical axis `number` is no servo axis; empty when it is one.
  std::string no_servo_axis(int number) const {
    const auto a = static_cast<std::uint32_t>(number);
    const int most = p_.integer(parameter::maximum_axes);
    if (number >= most)
      return join({"which does not exist: the axes are 0 .. ", std::to_string(most - 1), " (parameter ",
                   number_text(parameter::maximum_axes.number()), ")"});
    if (p_.text(parameter::axis_name, a).empty())
      return join({"which does not exist: it has no name (parameter ",
                   number_text(parameter::axis_name.number(a)), ")"});
    if (p_.integer(parameter::axis_type, a) == axis_type_spindle)
      return join({"which is a spindle (parameter ", number_text(parameter::axis_type.number(a)), " is ",
                   std::to_string(axis_type_spindle), ")"});
    return "";
  }

  void letters(std::uint16_t channel) {
    for (std::uint32_t i = 0; i < canonical::axis_count; ++i) {
      const Letter letter{channel, i};
      const int number = p_.integer(parameter::channel_axis, channel, i);
      if (number < 0) continue;
      const auto who =
          join({named(parameter::channel_axis, channel, i), ": ", letter.text(), " is ", axis_text(number)});
      if (const auto why = no_servo_axis(number); !why.empty()) {
        add({letter.number()}, {who, ", ", why});
        continue;
      }
      const auto [first, is_first] = letters_.emplace(number, letter);
      if (!is_first)
        add({letter.number(), first->second.number()},
            {who, ", which is ", first->second.text(), " already (parameter ",
             number_text(first->second.number()), "): an axis has one letter of one channel"});
    }
  }

  void spindles(std::uint16_t channel) {
    const auto number = parameter::tapping_spindle.number(channel);
    const int first = p_.integer(parameter::tapping_spindle, channel);
    auto at = std::find_if(spindles_.begin(), spindles_.end(),
                           [&](const auto& spindle) { return first < 0 || spindle.number == first; });
    if (first >= 0) {
      const auto who = join({named(parameter::tapping_spindle, channel), ": ", axis_text(first)});
      if (at == spindles_.end()) {
        add({number}, {who, " is no spindle of the machine"});
        return;
      }
      const auto [other, is_first] = tapping_.emplace(first, channel);
      if (!is_first)
        add({number, parameter::tapping_spindle.number(other->second)},
            {who, " is the spindle of channel ", std::to_string(other->second), " already (parameter ",
             number_text(parameter::tapping_spindle.number(other->second)),
             "): two channels must not couple one spindle"});
    }
    for (std::uint32_t i = canonical::A; i < canonical::axis_count; ++i) {
      if (p_.integer(parameter::channel_axis, channel, i) != spindle_letter) continue;
      if (at != spindles_.end()) {
        ++at;
        continue;
      }
      const Letter letter{channel, i};
      add({letter.number(), number}, {named(parameter::channel_axis, channel, i), ": ", letter.text(),
                                      " is a spindle (-2), and the machine has no further one: it has ",
                                      std::to_string(spindles_.size())});
    }
  }

  void gantries() {
    std::map<int, std::uint32_t> slaves;  // with the parameter that names each
    const auto count = static_cast<std::uint32_t>(p_.integer(parameter::gantry_slaves));
    for (std::uint32_t i = 0; i < count; ++i) {
      const int slave = p_.integer(parameter::gantry_slave_axis, 0, i);
      if (slave < 0) continue;
      const auto number = parameter::gantry_slave_axis.number(0, i);
      if (const auto [first, is_first] = slaves.emplace(slave, number); !is_first)
        add({number, first->second}, {named(parameter::gantry_slave_axis, 0, i), ": ", axis_text(slave),
                                      " is a slave already (parameter ", number_text(first->second), ")"});
    }
    std::set<int> masters;
    for (const auto& [slave, number] : slaves) {
      if (!is_gantry_slave(p_, slave)) continue;
      if (auto fault = gantry_fault(p_, axes_, slave)) {
        faults_.push_back(std::move(*fault));
        continue;
      }
      couple(slave, number, slaves);
      drive_word(slave, true);
      masters.insert(p_.integer(parameter::gantry_master, static_cast<std::uint32_t>(slave)));
    }
    for (const int master : masters)
      if (!slaves.contains(master)) drive_word(master, false);
  }

  // PB64: a drive whose tens say the wrong side would exchange nothing with its partner, without a word.
  void drive_word(int axis, bool slave) {
    const auto a = static_cast<std::uint32_t>(axis);
    const auto drive = DriveSynchronization::from(p_, a);
    if (!drive.on || drive.slave == slave) return;
    const int word = p_.integer(parameter::drive_synchronization, a), tens = word / 10 % 10 * 10;
    add({parameter::drive_synchronization.number(a)},
        {named(parameter::drive_synchronization, a), ": PB64 of ", axis_text(axis), ", a ",
         slave ? "slave" : "master", " of a gantry, is ", std::to_string(word),
         ", and its tens make the drive a ", slave ? "master" : "slave", ": enter ",
         std::to_string(slave ? word + 10 : word - tens)});
  }

  // Slave and master exist.
  void couple(int slave, std::uint32_t number, const std::map<int, std::uint32_t>& slaves) {
    const auto a = static_cast<std::uint32_t>(slave);
    const int master = p_.integer(parameter::gantry_master, a);
    const auto master_number = parameter::gantry_master.number(a);
    const auto who = join({named(parameter::gantry_master, a), ": ", axis_text(master)});
    if (const auto letter = letters_.find(slave); letter != letters_.end())
      add({letter->second.number(), number},
          {"parameter ", number_text(number), " (", parameter::gantry_slave_axis.name,
           "): ", axis_text(slave), " is the slave of ", axis_text(master), " and ", letter->second.text(),
           " (parameter ", number_text(letter->second.number()), "): a slave is an axis of no channel"});
    if (slaves.contains(master) && is_gantry_slave(p_, master))
      add({master_number}, {who, ", the master of ", axis_text(slave), ", is itself a slave (parameter ",
                            number_text(slaves.at(master)), ")"});
    else if (!letters_.contains(master))
      add({master_number}, {who, ", the master of ", axis_text(slave),
                            ", is an axis of no channel (parameters 04c001 .. 04c009)"});
  }

  std::string value_text(const ParameterKey& key, std::uint32_t unit, std::uint32_t index = 0) const {
    const auto number = key.number(unit, index);
    std::ostringstream text;
    text << std::setprecision(15) << p_.at(number) << " " << unit_of(number, p_.values);
    return text.str();
  }

  void travel(const AxisInfo& axis) {
    const auto a = axis.number;
    const double low = p_.get(parameter::negative_limit, a), high = p_.get(parameter::positive_limit, a);
    const auto low_number = parameter::negative_limit.number(a),
               high_number = parameter::positive_limit.number(a);
    const auto who = ": " + axis_text(a);
    if (low >= high) {
      add({low_number, high_number},
          {named(parameter::negative_limit, a), who, " has its negative travel limit at ",
           value_text(parameter::negative_limit, a), ", which is not below the positive one at ",
           value_text(parameter::positive_limit, a), " (parameter ", number_text(high_number), ")"});
      return;
    }
    const auto inside = [&](const RealParameter& key, std::uint32_t index, const std::string& point) {
      const double at = p_.get(key, a, index);
      if (at >= low && at <= high) return;
      add({key.number(a, index), at < low ? low_number : high_number},
          {named(key, a, index), who, " has ", point, " at ", value_text(key, a, index),
           ", outside its travel of ", value_text(parameter::negative_limit, a), " .. ",
           value_text(parameter::positive_limit, a), " (parameters ", number_text(low_number), ", ",
           number_text(high_number), ")"});
    };
    inside(parameter::reference_coordinate, 0, "its reference point");
    // Nobody has to enter the points of G30.
    for (std::uint32_t k = 0; k < numbered_references; ++k)
      if (p_.values.contains(parameter::numbered_reference.number(a, k)))
        inside(parameter::numbered_reference, k, "reference point " + std::to_string(k + 2));
  }

  void gear(const AxisInfo& axis) {
    constexpr double least = 1;  // um or mdeg
    const auto a = axis.number;
    if (std::abs(p_.get(parameter::travel_per_revolution, a)) >= least) return;
    add({parameter::travel_per_revolution.number(a)},
        {named(parameter::travel_per_revolution, a), ": ", axis_text(a), " travels ",
         value_text(parameter::travel_per_revolution, a),
         " for one revolution of its motor: at least 1, or -1 when the motor turns the other way"});
  }

  void skip_input(std::uint32_t i) {
    const int axis = p_.integer(parameter::skip_input_axis, 0, i);
    if (axis < 0) return;
    if (const auto why = no_servo_axis(axis); !why.empty())
      add({parameter::skip_input_axis.number(0, i)},
          {named(parameter::skip_input_axis, 0, i), ": skip input ", std::to_string(i + 1),
           " is switched by ", axis_text(axis), ", ", why});
  }

  const Parameters& p_;
  const std::vector<AxisInfo> axes_, spindles_;
  std::map<int, Letter> letters_;         // the first of each axis
  std::map<int, std::uint16_t> tapping_;  // the first channel that names each spindle
  std::vector<ParameterFault> faults_;
};

}  // namespace

std::vector<ParameterFault> axis_faults(const Parameters& parameters) {
  return AxisFaults(parameters).find();
}

}  // namespace trunnion::machine
