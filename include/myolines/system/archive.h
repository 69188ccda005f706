// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/algebra/vector.h>

#include <map>
#include <string>
#include <vector>

namespace myolines
{
  /// Named numbers and vectors: what a part of a run must remember to go on exactly. Values are kept bit for bit.
  /// Numbers are the same on all ranks; of a vector a rank keeps its owned entries.
  class Archive
  {
  public:
    ///@{
    /// A value under a name, in place of what was there.
    void put(const std::string &name, double value);
    void put(const std::string &name, const Vector &owned_entries);
    void put_numbers(const std::string &name, std::vector<double> values);
    void put_owned_entries(const std::string &name, std::vector<double> values);
    ///@}

    bool has_numbers(const std::string &name) const { return numbers_.count(name) > 0; } ///< whether numbers were put under @p name

    /// @throws std::out_of_range if nothing was put under @p name, here and below.
    double                     number(const std::string &name) const;
    const std::vector<double> &numbers(const std::string &name) const; ///< All numbers that were put under @p name.

    /// Fills the owned entries of @p vector, which must have the layout of the vector that was put, and updates its ghosts.
    void read(const std::string &name, Vector &vector) const;

    const std::map<std::string, std::vector<double>> &all_numbers() const { return numbers_; } ///< by name
    const std::map<std::string, std::vector<double>> &all_vectors() const { return vectors_; } ///< owned entries, by name

  private:
    std::map<std::string, std::vector<double>> numbers_;
    std::map<std::string, std::vector<double>> vectors_;
  };
} // namespace myolines
