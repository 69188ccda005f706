// SPDX-License-Identifier: LGPL-2.1-or-later
#include "batch_script.h"

#include <myolines/base/names.h>

namespace myolines::study
{
  namespace
  {
    std::string study_call(const BatchCall &call)
    {
      std::vector<std::string> words{call.program.string(), "study", call.file.string(), "--out", call.folder.string()};
      for (const std::string &setting : call.overrides)
        words.insert(words.end(), {"--set", setting});
      for (const std::filesystem::path &file : call.plugins)
        words.insert(words.end(), {"--plugin", file.string()});
      return shell_text(words);
    }
  } // namespace

  std::string slurm_script(const BatchCall &call)
  {
    const std::string n = std::to_string(call.tasks), log = shell_text({(call.folder / "slurm-%A-%a.log").string()});
    return "#!/bin/bash\n"
           "# sbatch THIS_FILE            runs the cases\n"
           "# bash THIS_FILE collect      afterwards: runs what is left, measures and writes the tables\n"
           "#SBATCH --array=1-" +
           n +
           "\n"
           "#SBATCH --ntasks=" +
           std::to_string(call.ranks) +
           "\n"
           "#SBATCH --cpus-per-task=1\n"
           "#SBATCH --output=" +
           log +
           "\n"
           "set -eu\n"
           "export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1\n"
           "if [ \"${1:-}\" = collect ]; then\n"
           "  exec " +
           study_call(call) +
           "\n"
           "fi\n"
           "exec " +
           study_call(call) + " --part \"$SLURM_ARRAY_TASK_ID/" + n + "\" --jobs " +
           (call.ranks == 1 ? "\"${SLURM_CPUS_PER_TASK:-1}\"" : "1") + " --quiet\n";
  }

  std::string mpi_script(const BatchCall &call)
  {
    const std::string groups = std::to_string(call.tasks), ranks = std::to_string(call.ranks),
                      all = std::to_string(call.tasks * call.ranks);
    return "#!/bin/bash\n"
           "# bash THIS_FILE              runs the cases as one job of Open MPI, then measures and writes the tables\n"
           "# " +
           all + " ranks in groups of " + ranks +
           ": the first of a group starts its cases, the others leave it their cores\n"
           "set -eu\n"
           "export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1\n"
           "if [ \"${1:-}\" = part ]; then\n"
           "  [ $((OMPI_COMM_WORLD_RANK % " +
           ranks +
           ")) = 0 ] || exit 0\n"
           "  part=$((OMPI_COMM_WORLD_RANK / " +
           ranks +
           " + 1))\n"
           "  for name in ${!OMPI_*} ${!PMIX_*} ${!ORTE_*} ${!PRTE_*} ${!SLURM_*}; do # a program of its own, on this node\n"
           "    [[ \" $given \" = *\" $name \"* ]] || unset \"$name\"\n"
           "  done\n"
           "  exec " +
           study_call(call) + " --part \"$part/" + groups +
           "\" --jobs 1 --quiet\n"
           "fi\n"
           "export given=\"${!OMPI_*} ${!PRTE_*}\" # settings of the user, not of the job\n"
           "mpirun -x given --bind-to none -np " +
           all +
           " bash \"$0\" part\n"
           "exec " +
           study_call(call) + "\n";
  }
} // namespace myolines::study
