// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/scene/scene.h>
#include <myolines/system/semi_discrete_system.h>
#include <myolines/time/butcher_table.h>

#include <optional>
#include <string>
#include <vector>

namespace myolines
{
  /// Butcher tables by the names that ARKODE gives them, "ARKODE_" left out: the last numbers are stages, order of the embedded
  /// formula, order; or the coefficients of the scene, "own".
  struct ArkodeTables
  {
    std::optional<std::string>  implicit;  ///< diagonally implicit; none: explicit method
    std::optional<std::string>  explicit_; ///< none: implicit method
    std::optional<ButcherTable> own;       ///< of the one table that is "own"

    bool additive() const { return implicit && explicit_; } ///< whether there are both

    int order() const;          ///< of the method
    int embedded_order() const; ///< of the formula that estimates errors, 0: there is none
    int stages() const;         ///< how many there are

    /// Gives the tables to @p memory of ARKStep.
    void set(void *memory) const;

    /// Longest step [s] with which the explicit method amplifies no mode of a + c v + k u = 0 by more than a millionth: some methods
    /// amplify undamped ones a little at every step. @p stiffness k [1/s^2], @p rates c [1/s]; infinity if both are 0.
    double stable_step(double stiffness, double rates) const;
  };

  const std::vector<std::string> &arkode_implicit_tables(); ///< Names of the diagonally implicit tables that ARKODE has.
  const std::vector<std::string> &arkode_explicit_tables(); ///< Names of its explicit tables.

  /// Pairs that belong together, implicit and explicit table of each.
  const std::vector<std::pair<std::string, std::string>> &arkode_additive_pairs();

  /// Declares the parameters `implicit table`, `explicit table`, `A`, `b`, `embedded`, `split`, `force` and `most explicit steps`.
  void declare_arkode_tables(scene::Schema &schema);

  /// The tables that @p integrator asks for. @throws InputError if there is none, if two do not belong together, or if @p system
  /// lacks the split or it is refused.
  ArkodeTables arkode_tables(const scene::Node &integrator, const SemiDiscreteSystem &system);

  /// The same without a system to look at, for `check`.
  ArkodeTables arkode_tables(const scene::Node &integrator);
} // namespace myolines
