// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/muscle3d/body_measures.h>
#include <myolines/output/output_folder.h>
#include <myolines/scene/scene.h>
#include <myolines/time/loop.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace myolines
{
  /// Parameters of the optional list `fields`.
  scene::Schema field_output_schema();

  /// Writes fields-NNNN.vtu (.pvtu) or fields-NNNN.h5 and keeps fields.pvd or fields.xdmf, their list, valid at all times.
  /// Ledger: "field outputs"; seconds of "output fields".
  /// @throws InputError for an unknown field.
  std::unique_ptr<Observer> make_fields(const scene::Node &fields, const Muscle3dSystem &system, const OutputFolder &folder,
                                        WorkLedger &ledger);

  /// Parameters of the optional list `quadrature`, and what writes the tables it asks for. @throws InputError for an unknown column.
  /// Ledger: "quadrature outputs"; seconds of "output quadrature".
  scene::Schema point_tables_schema();
  /// What writes those tables. @throws InputError for an unknown column.
  std::unique_ptr<Observer> make_point_tables(const scene::Node &quadrature, const Muscle3dSystem &system, const OutputFolder &folder,
                                              WorkLedger &ledger);

  /// The names in `what` = "displacement, fibre stretch" of @p list. @throws InputError for one that is not in @p known, or for none at
  /// all; @p kind says of what ("field").
  std::vector<std::string> read_names(const scene::Node &list, const std::vector<std::string> &known, const std::string &kind);

  /// ParaView collection of files, each valid from its time on [s].
  std::string pvd_text(const std::vector<std::pair<double, std::string>> &files);
} // namespace myolines
