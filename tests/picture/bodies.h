// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/body.h>

#include <functional>

namespace myolines::test
{
  /// nx x ny x nz cells of the block [0, 3] x [0, 2] x [0, 1], whose points have been moved by @p place; cells share no points.
  inline picture::Body block(const std::size_t nx, const std::size_t ny, const std::size_t nz,
                             const std::function<picture::Vec(const picture::Vec &)> &place)
  {
    picture::Body body;
    for (std::size_t k = 0; k < nz; ++k)
      for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i)
          {
            picture::Body::Cell cell;
            for (std::size_t v = 0; v < 8; ++v)
              {
                cell[v] = body.rest.size();
                body.rest.push_back(place(picture::Vec({3. * static_cast<double>(i + v % 2) / static_cast<double>(nx),
                                                        2. * static_cast<double>(j + v / 2 % 2) / static_cast<double>(ny),
                                                        1. * static_cast<double>(k + v / 4) / static_cast<double>(nz)})));
              }
            body.cells.push_back(cell);
          }
    body.now = body.rest;
    return body;
  }

  inline picture::Vec same(const picture::Vec &x) { return x; }

  /// A field from the places at rest.
  inline void add_field(picture::Body &body, const std::string &name, const std::function<double(const picture::Vec &)> &value)
  {
    picture::Field field{name, 1, {}};
    for (const picture::Vec &x : body.rest)
      field.values.push_back(value(x));
    body.fields.push_back(field);
  }

  inline void add_vector_field(picture::Body &body, const std::string &name, const std::function<picture::Vec(const picture::Vec &)> &value)
  {
    picture::Field field{name, 3, {}};
    for (const picture::Vec &x : body.rest)
      {
        const picture::Vec v = value(x);
        field.values.insert(field.values.end(), v.begin_raw(), v.end_raw());
      }
    body.fields.push_back(field);
  }
} // namespace myolines::test
