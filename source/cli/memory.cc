#include <myolines/cli/catalogue.h>
#include <myolines/cli/memory.h>
#include <myolines/solve/preconditioner.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

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
      double program        = 0.2e9; ///< the program with its libraries, measured
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
      const double       ranks          = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const SizeEstimate size           = system_entry(system.text("type"), system.where("type")).size(system, ranks);

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

    double physical_memory() { return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)); }

    std::string gigabytes(const double bytes)
    {
      std::ostringstream text;
      text.precision(3);
      text << bytes / 1e9 << " GB";
      return text.str();
    }
  } // namespace

  std::vector<std::string> memory_lines(const scene::Node &scene)
  {
    const Need n = need(scene);
    return {"memory of a rank: about " + gigabytes(n.total()) + " (program " + gigabytes(n.program) + ", system and tangent " +
                gigabytes(n.system) + ", Krylov vectors " + gigabytes(n.krylov) + ", preconditioner " + gigabytes(n.preconditioner) + ")",
            "memory of this node: " + gigabytes(physical_memory()) + " for " + std::to_string(ranks_of_this_node()) + " rank(s)"};
  }

  void refuse_too_large(const scene::Node &scene)
  {
    const double       wanted = need(scene).total();
    const unsigned int ranks  = ranks_of_this_node();
    const bool         fits   = wanted * ranks <= physical_memory();
    if (dealii::Utilities::MPI::min(fits ? 1 : 0, MPI_COMM_WORLD) == 1)
      return;
    scene.refuse("system", "the run wants about " + gigabytes(wanted) + " for each of " + std::to_string(ranks) + " rank(s) of a node",
                 "at most the physical memory of the node, " + gigabytes(physical_memory()),
                 "a smaller system/geometry/refinement or degree, more nodes with fewer ranks on each, or solver/preconditioner/type "
                 "\"p multigrid\" instead of direct or ml");
  }
} // namespace myolines
