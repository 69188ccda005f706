// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/system/archive.h>

#include <algorithm>

namespace myolines
{
  void Archive::put(const std::string &name, const double value) { numbers_[name] = {value}; }

  void Archive::put(const std::string &name, const Vector &owned_entries)
  {
    vectors_[name].assign(owned_entries.begin(), owned_entries.end());
  }

  void Archive::put_numbers(const std::string &name, std::vector<double> values) { numbers_[name] = std::move(values); }

  void Archive::put_owned_entries(const std::string &name, std::vector<double> values) { vectors_[name] = std::move(values); }

  double Archive::number(const std::string &name) const { return numbers(name).at(0); }

  const std::vector<double> &Archive::numbers(const std::string &name) const { return numbers_.at(name); }

  void Archive::read(const std::string &name, Vector &vector) const
  {
    const std::vector<double> &values = vectors_.at(name);
    AssertThrow(values.size() == vector.locally_owned_size(),
                dealii::ExcMessage("archive entry '" + name + "' has another length than the vector to fill"));
    vector.zero_out_ghost_values(); // entries can only be written while the ghosts are not "current"
    std::copy(values.begin(), values.end(), vector.begin());
    vector.update_ghost_values();
  }
} // namespace myolines
