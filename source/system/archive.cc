#include <myolines/system/archive.h>

#include <algorithm>

namespace myolines
{
  void Archive::put(const std::string &name, const double value) { entries_[name] = {value}; }

  void Archive::put(const std::string &name, const Vector &owned_entries)
  {
    entries_[name].assign(owned_entries.begin(), owned_entries.end());
  }

  double Archive::number(const std::string &name) const { return entries_.at(name).at(0); }

  void Archive::read(const std::string &name, Vector &vector) const
  {
    const std::vector<double> &values = entries_.at(name);
    AssertThrow(values.size() == vector.locally_owned_size(),
                dealii::ExcMessage("archive entry '" + name + "' has another length than the vector to fill"));
    std::copy(values.begin(), values.end(), vector.begin());
    vector.update_ghost_values();
  }
} // namespace myolines
