// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/picture/sheet.h>
#include <myolines/picture/surface.h>
#include <myolines/picture/view.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace myolines::picture
{
  /// The values of @p field at all points: of a scalar, the length of a vector ("displacement"), or a component of one ("displacement x").
  /// Nothing if the body has no such field.
  std::optional<std::vector<double>> values_of(const Body &body, const std::string &field);

  /// What values_of() knows of @p body.
  std::vector<std::string> colourable_fields(const Body &body);

  /// The field that shows most if none is named: stretch if it is there, else the first.
  std::string first_field(const Body &body);

  /// How bodies are drawn.
  struct Style
  {
    std::string                              field;            ///< see values_of()
    std::optional<std::pair<double, double>> range;            ///< of the colours, in the unit of the field; none: what is there
    std::optional<Cut>                       cut;              ///< what is taken away; none: nothing
    double                                   azimuth   = 25;   ///< of view_of() [degree]
    double                                   elevation = 20;   ///< of view_of() [degree]
    unsigned int                             width     = 1200; ///< [px]
  };

  /// A body to draw.
  struct Panel
  {
    std::string                   title; ///< above the body
    std::shared_ptr<const Body>   body;  ///< at one instant
    std::vector<std::vector<Vec>> lines; ///< points at rest, fibre_lines(); if there are any, the surface is a veil around them
  };

  /// What several pictures have in common, so that they can be laid side by side: view, frame and range of the colours.
  struct Frame
  {
    View                      view;  ///< where bodies are seen from
    Vec                       low;   ///< least coordinates of what is seen [m]
    Vec                       high;  ///< greatest [m]
    std::pair<double, double> range; ///< of the field
  };

  /// From the first body, so that all of them fit. @throws InputError if one has no such field, or no finite value of it.
  Frame frame_of(const std::vector<Panel> &panels, const Style &style);

  /// Makes @p frame larger so that @p other fits too.
  void widen(Frame &frame, const Frame &other);

  /// The panels side by side, with a colour bar and a bar of length.
  Sheet sheet_of(const std::vector<Panel> &panels, const Style &style, const Frame &frame);
} // namespace myolines::picture
