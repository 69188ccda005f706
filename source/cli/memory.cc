// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/error.h>
#include <myolines/cli/catalogue.h>
#include <myolines/cli/memory.h>
#include <myolines/cli/memory_limit.h>
#include <myolines/scene/numbers.h>
#include <myolines/solve/preconditioner.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Bytes on one rank.
    struct Need
    {
      double program        = memory_of_the_program;
      double system         = 0;
      double krylov         = 0;
      double preconditioner = 0;

      double total() const { return program + system + krylov + preconditioner; }
    };

    /// Bytes of the preconditioner. Factors of a three-dimensional body grow like n^(4/3): 0.2 GB for 14,739 unknowns, 3 GB
    /// for 107,811. A hierarchy takes at most what its matrix takes.
    double preconditioner_bytes(const scene::Node &preconditioner, const SizeEstimate &size, const double ranks)
    {
      const std::string wanted = preconditioner.text("type");
      const std::string type =
          wanted == "automatic"
              ? automatic_choice(preconditioner, static_cast<std::size_t>(std::min(size.n_unknowns, 1e18)), size.two_level_bytes > 0)
              : wanted;
      const double factors = 560 * std::pow(size.n_unknowns, 4. / 3) / ranks;
      if (type == "direct")
        return size.matrix_bytes + factors;
      return type == "p multigrid" ? size.two_level_bytes : 2 * size.matrix_bytes;
    }

    Need need(const scene::Node &scene)
    {
      const scene::Node &system         = scene.section("system");
      const scene::Node &linear         = scene.section("solver").section("linear");
      const scene::Node &preconditioner = scene.section("solver").section("preconditioner");
      const double       ranks          = // a study asks before MPI starts
          dealii::Utilities::MPI::job_supports_mpi() ? dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) : 1;
      const SizeEstimate size = system_entry(system.text("type"), system.where("type")).size(system, ranks);

      Need need;
      need.system = size.bytes;
      if (size.banded && preconditioner.text("type") == "automatic")
        return need;
      need.krylov         = (2. * linear.integer("restart") + 7) * size.n_unknowns / ranks * sizeof(double);
      need.preconditioner = preconditioner_bytes(preconditioner, size, ranks);
      return need;
    }

    unsigned int ranks_of_this_node()
    {
      MPI_Comm node;
      MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
      const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(node);
      MPI_Comm_free(&node);
      return ranks;
    }

    std::string gigabytes(const double bytes)
    {
      std::ostringstream text;
      text.precision(3);
      text << bytes / 1e9 << " GB";
      return text.str();
    }
  } // namespace

  double memory_of_a_rank(const scene::Node &scene) { return need(scene).total(); }

  std::vector<std::string> memory_lines(const scene::Node &scene)
  {
    const Need        n     = need(scene);
    const MemoryLimit limit = memory_limit();
    return {"memory of a rank: about " + gigabytes(n.total()) + " (program " + gigabytes(n.program) + ", system and tangent " +
                gigabytes(n.system) + ", Krylov vectors " + gigabytes(n.krylov) + ", preconditioner " + gigabytes(n.preconditioner) + ")",
            "memory of this node: " + gigabytes(limit.bytes) + ", " + limit.origin + ", for " + std::to_string(ranks_of_this_node()) +
                " rank(s)"};
  }

  void refuse_too_large(const scene::Node &scene)
  {
    const double       wanted = need(scene).total();
    const unsigned int ranks  = ranks_of_this_node();
    const MemoryLimit  limit  = memory_limit();
    const bool         fits   = wanted * ranks <= limit.bytes && wanted <= memory_limit_of_a_process();
    if (dealii::Utilities::MPI::min(fits ? 1 : 0, MPI_COMM_WORLD) == 1)
      return;
    scene.refuse("system", "the run wants about " + gigabytes(wanted) + " for each of " + std::to_string(ranks) + " rank(s) of a node",
                 wanted * ranks > limit.bytes ? "at most the memory of the node, " + gigabytes(limit.bytes) + ", " + limit.origin
                                              : "at most what a process may take, " + gigabytes(memory_limit_of_a_process()) + " (ulimit)",
                 "a smaller system/geometry/refinement or degree, more nodes with fewer ranks on each, or solver/preconditioner/type "
                 "\"p multigrid\" instead of direct or ml");
  }

  unsigned int jobs_that_fit(const double bytes_of_a_run, const unsigned int wanted, const bool asked_for)
  {
    const MemoryLimit limit = memory_limit();
    const double      fit   = std::floor(limit.bytes / bytes_of_a_run);
    if (fit >= wanted)
      return wanted;
    if (asked_for)
      throw InputError(InputProblem{"--jobs", std::to_string(wanted) + " runs at a time want about " + gigabytes(wanted * bytes_of_a_run),
                                    "at most the memory of the node, " + gigabytes(limit.bytes) + ", " + limit.origin,
                                    fit >= 1 ? "--jobs " + scene::format_number(fit) : "smaller runs"});
    return std::max(1u, static_cast<unsigned int>(fit));
  }
} // namespace myolines
