#pragma once

#include <myolines/algebra/vector.h>

#include <map>
#include <string>
#include <vector>

namespace myolines
{
  /// Named numbers and vectors of a rank: what an integrator or a step control must remember to go on exactly.
  /// Values are kept bit for bit.
  class Archive
  {
  public:
    void put(const std::string &name, double value);
    void put(const std::string &name, const Vector &owned_entries);

    /// @throws std::out_of_range if nothing was put under @p name.
    double number(const std::string &name) const;

    /// Fills the owned entries of @p vector, which must have the layout of the vector that was put, and updates its ghosts.
    void read(const std::string &name, Vector &vector) const;

    const std::map<std::string, std::vector<double>> &entries() const { return entries_; }

  private:
    std::map<std::string, std::vector<double>> entries_;
  };
} // namespace myolines
