#pragma once

#include <myolines/scene/scene.h>

#include <string>
#include <vector>

namespace myolines
{
  /// Memory that a run of @p scene will take on this rank, estimated from the parameters alone, in lines for `check`.
  std::vector<std::string> memory_lines(const scene::Node &scene);

  /// @throws InputError, before anything large is made, if the ranks of this node together want more than its physical memory: with
  /// the numbers and how to mend it. Collective.
  void refuse_too_large(const scene::Node &scene);
} // namespace myolines
