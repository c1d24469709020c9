#include "coupler/account.hpp"

#include <algorithm>

#include "core/exchange/errors.hpp"

namespace polynya::coupler {

void Account::set_names(const exchange::Message& ready) {
  names_ = ready.header.value("account", std::vector<std::string>{});
  update(ready);
  initial_ = values_;
}

void Account::update(const exchange::Message& message) {
  if (names_.empty()) return;
  const auto values = message.view<double>("account");
  if (values.size() != names_.size())
    throw exchange::ProtocolError("message '" + message.kind() + "': array 'account' has " +
                                  std::to_string(values.size()) + " values, 'ready' announced " +
                                  std::to_string(names_.size()) + " names");
  values_.assign(values.begin(), values.end());
}

void Account::set_initial(const exchange::Message& message) {
  update(message);
  initial_ = values_;
}

bool Account::has(std::string_view name) const {
  return std::find(names_.begin(), names_.end(), name) != names_.end();
}

double Account::operator[](std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? 0.0 : values_[static_cast<std::size_t>(found - names_.begin())];
}

double Account::initial(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? 0.0 : initial_[static_cast<std::size_t>(found - names_.begin())];
}

double Account::change(std::initializer_list<std::string_view> names) const {
  double sum = 0;
  for (std::string_view name : names) sum += change(name);
  return sum;
}

}  // namespace polynya::coupler
