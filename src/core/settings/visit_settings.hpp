// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <type_traits>

#include <sks_detector/settings.hpp>

namespace sks {

/// What a visit() function says about a setting, besides its key and value.
struct About {
  Range range;
  const char* unit;
  const char* help;
  Binding binding;
};

/// Turns the nested visit() functions into one call `f(key, value, about)` for each setting.
template <typename Function>
class Flatten {
public:
  explicit Flatten(Function& function) : function_(function) {}

  template <typename T>
  void operator()(T& value, const char* name, Range range, const char* unit, const char* help,
                  Binding binding = Binding::free) {
    function_(prefix_ + name, value, About{range, unit, help, binding});
  }

  template <typename T>
  void operator()(T& value, const char* name, const char* help, Binding binding = Binding::free) {
    function_(prefix_ + name, value, About{Range{}, "", help, binding});
  }

  template <typename Group>
  void group(const char* name, Group& group) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    std::remove_const_t<Group>::visit(group, *this);
    prefix_ = outer;
  }

private:
  Function& function_;
  std::string prefix_;
};

/// Calls `f(key, value, about)` for each setting of a struct with a visit() function, in its order; `value` is a
/// reference into `settings`.
template <typename T, typename Function>
void forEachSetting(T& settings, Function function) {
  std::remove_const_t<T>::visit(settings, Flatten<Function>(function));
}

}  // namespace sks
