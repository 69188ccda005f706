// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/cli/memory_limit.h>
#include <myolines/scene/numbers.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

namespace myolines
{
  namespace
  {
    /// The number in a file of the kernel; none if there is no such file or it says "max".
    std::optional<double> number_in(const std::filesystem::path &file)
    {
      std::ifstream stream(file);
      std::string   word;
      stream >> word;
      return scene::parse_number(word);
    }

    /// The least limit in the folder @p group below @p root and in those above it: each holds for all below.
    double least_limit(const std::filesystem::path &root, std::filesystem::path group, const char *file)
    {
      double least = std::numeric_limits<double>::infinity();
      for (group = group.relative_path();; group = group.parent_path())
        {
          if (const auto limit = number_in(root / group / file))
            least = std::min(least, *limit);
          if (group.empty())
            return least;
        }
    }

    /// Lines "0::/user.slice/a" (version 2) and "4:memory:/user.slice/a" (version 1) of the groups of this process.
    double limit_of_control_groups()
    {
      double        least = std::numeric_limits<double>::infinity();
      std::ifstream groups("/proc/self/cgroup");
      for (std::string line; std::getline(groups, line);)
        {
          const std::size_t first = line.find(':'), second = line.find(':', first + 1);
          if (second == std::string::npos)
            continue;
          const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",", group = line.substr(second + 1);
          if (controllers == ",,")
            least = std::min(least, least_limit("/sys/fs/cgroup", group, "memory.max"));
          else if (controllers.find(",memory,") != std::string::npos)
            least = std::min(least, least_limit("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
        }
      return least;
    }

    std::optional<double> variable(const char *name)
    {
      const char *text = std::getenv(name);
      return text == nullptr ? std::nullopt : scene::parse_number(text);
    }
  } // namespace

  MemoryLimit memory_limit()
  {
    MemoryLimit limit{double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)), "physical memory of the node"};
    const auto  consider = [&limit](const double bytes, const std::string &origin) {
      if (bytes > 0 && bytes < limit.bytes)
        limit = {bytes, origin};
    };
    consider(limit_of_control_groups(), "limit of its control group");
    constexpr double megabyte = 1048576; // as Slurm counts
    if (const auto node = variable("SLURM_MEM_PER_NODE"))
      consider(*node * megabyte, "of the batch job (SLURM_MEM_PER_NODE)");
    const auto each = variable("SLURM_MEM_PER_CPU"), cores = variable("SLURM_CPUS_ON_NODE");
    if (each && cores)
      consider(*each * *cores * megabyte, "of the batch job (SLURM_MEM_PER_CPU)");
    return limit;
  }

  double memory_limit_of_a_process()
  {
    double least = std::numeric_limits<double>::infinity();
    for (const auto resource : {RLIMIT_AS, RLIMIT_DATA})
      if (rlimit limit{}; getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        least = std::min(least, static_cast<double>(limit.rlim_cur));
    return least;
  }
} // namespace myolines
