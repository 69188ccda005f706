// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/base/tensor.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace myolines::picture
{
  using Vec = dealii::Tensor<1, 3>; ///< A place or a vector in space.

  /// Numbers at the points of a body.
  struct Field
  {
    std::string         name;         ///< with blanks, as scenes spell it: "fibre direction"
    unsigned int        n_components; ///< 1 or 3
    std::vector<double> values;       ///< [points][components]

    double norm(std::size_t point) const; ///< of a vector; a number itself
  };

  /// A body at one instant, as the files of a run have it: hexahedra with straight edges, into which cells of higher order are cut.
  /// Cells share no points: a field may have a value on either side.
  struct Body
  {
    using Cell = std::array<std::size_t, 8>; ///< points, the first index fastest: (0,0,0), (1,0,0), (0,1,0), ...

    double             t = 0;  ///< [s]
    std::vector<Vec>   rest;   ///< places of the points at rest [m]
    std::vector<Vec>   now;    ///< places at t [m]; those at rest where the run wrote no displacements
    std::vector<Cell>  cells;  ///< each with points of its own
    std::vector<Field> fields; ///< that the run wrote

    std::vector<std::string> tissues; ///< names by number, from 1 on

    const Field *find(const std::string &name) const; ///< nullptr if there is none
    /// The tissues that the field "tissue" has anywhere, by number; none without the field.
    std::map<int, std::string> tissues_present() const;
    /// Whether @p other has the same points at rest and the same cells.
    bool is_on_the_mesh_of(const Body &other) const;
  };

  /// The list of the fields that a run wrote.
  class RunFields
  {
  public:
    /// From fields.pvd or fields.xdmf in @p folder. @throws InputError where there is none, or it is damaged.
    explicit RunFields(const std::filesystem::path &folder);

    std::size_t size() const { return instants_.size(); }               ///< how many instants there are
    double      time(std::size_t i) const { return instants_.at(i).t; } ///< [s]
    std::size_t nearest(double t) const;                                ///< the instant nearest to t [s]
    Body        read(std::size_t i) const;                              ///< @throws InputError for files that are missing or damaged

    /// Whether there are any.
    static bool are_in(const std::filesystem::path &folder);

  private:
    struct Instant
    {
      double                             t;
      std::vector<std::filesystem::path> files; ///< pieces; of HDF5 mesh and fields
    };
    std::vector<Instant>     instants_;
    std::vector<std::string> tissues_;
    bool                     hdf5_ = false;
  };

  // How places of a cell are counted: coordinates in [0, 1].

  /// The place with coordinates @p xi in @p cell, among @p places (rest or now).
  Vec place(const std::vector<Vec> &places, const Body::Cell &cell, const Vec &xi);
  /// d place / d xi, by columns.
  std::array<Vec, 3> derivatives(const std::vector<Vec> &places, const Body::Cell &cell, const Vec &xi);
  /// A component of a field there.
  double value(const Field &field, unsigned int component, const Body::Cell &cell, const Vec &xi);
} // namespace myolines::picture
