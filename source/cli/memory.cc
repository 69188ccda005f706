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
#include <numeric>
#include <sstream>

namespace myolines
{
  namespace
  {
    /// Bytes on one rank.
    struct Need
    {
      std::vector<std::pair<std::string, double>> rows{{"program", memory_of_the_program}};

      void add(const std::string &what, const double bytes)
      {
        if (bytes > 0)
          rows.emplace_back(what, bytes);
      }
      double total() const
      {
        return std::accumulate(rows.begin(), rows.end(), 0., [](const double sum, const auto &row) { return sum + row.second; });
      }
    };

    /// Vectors of a solve: of flexible gmres those of a third more iterations than solves at default tolerances take on the 3D muscle,
    /// one in double and one in single precision for each, and some around them.
    double krylov_bytes(const scene::Node &linear, const double n_unknowns)
    {
      constexpr int around = 7, iterations = 30;
      return n_unknowns *
             (around * sizeof(double) + std::min(iterations, int(linear.integer("restart"))) * (sizeof(double) + sizeof(float)));
    }

    /// Factors of a three-dimensional body grow like n^(4/3): 0.2 GB for 14,739 unknowns, 3 GB for 107,811. A hierarchy takes at most what
    /// its matrix takes.
    void add_preconditioner(const std::string &type, const SizeEstimate &size, const double ranks, Need &need)
    {
      if (type == "p multigrid")
        {
          need.add("patches", size.patch_bytes);
          need.add("coarse level", size.coarse_bytes);
          return;
        }
      need.add("assembled tangent", size.matrix_bytes);
      if (type == "direct")
        need.add("factors", 560 * std::pow(size.n_unknowns, 4. / 3) / ranks);
      if (type == "ml")
        need.add("hierarchy", size.matrix_bytes);
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
      need.add("system", size.bytes);
      const std::string wanted = preconditioner.text("type");
      if (size.banded && wanted == "automatic")
        return need;
      need.add("tangent", size.tangent_bytes);
      need.add("Krylov vectors", krylov_bytes(linear, size.n_unknowns / ranks));
      add_preconditioner(wanted == "automatic" ? automatic_choice(preconditioner, static_cast<std::size_t>(std::min(size.n_unknowns, 1e18)),
                                                                  size.patch_bytes > 0)
                                               : wanted,
                         size, ranks, need);
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
    std::string       rows;
    for (const auto &[what, bytes] : n.rows)
      rows += (rows.empty() ? "" : ", ") + what + " " + gigabytes(bytes);
    return {"memory of a rank: about " + gigabytes(n.total()) + " (" + rows + ")", "memory of this node: " + gigabytes(limit.bytes) + ", " +
                                                                                       limit.origin + ", for " +
                                                                                       std::to_string(ranks_of_this_node()) + " rank(s)"};
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
