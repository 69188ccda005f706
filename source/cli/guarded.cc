// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/base/on_one_rank.h>
#include <myolines/cli/guarded.h>
#include <myolines/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>
#include <new>
#include <thread>

namespace myolines
{
  namespace
  {
    /// Other ranks may not know of it and wait: whoever fails says so and ends the whole job.
    ExitCode end_alone(const std::string &kind, const std::string &what, const ExitCode code)
    {
      const bool several = dealii::Utilities::MPI::job_supports_mpi() && dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
      if (several && !writes_files())
        std::this_thread::sleep_for(std::chrono::seconds(1)); // if the first rank knows of it as well, it says so
      std::cerr << kind << what << std::endl;
      if (several)
        {
          std::this_thread::sleep_for(std::chrono::milliseconds(300)); // until mpirun has passed the words on
          MPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
        }
      return code;
    }
  } // namespace

  ExitCode flushed(const ExitCode code)
  {
    if (std::cout.flush() || code != ExitCode::done)
      return code;
    std::cerr << "The system refused: cannot write standard output" << std::endl;
    return ExitCode::system_refused;
  }

  ExitCode guarded(const std::function<void()> &command, std::ostream &err)
  {
    try
      {
        command();
        return ExitCode::done;
      }
    catch (const InputError &error)
      {
        err << error.what() << std::endl;
        return ExitCode::invalid_input;
      }
    catch (const OnOneRank<SolveError> &error)
      {
        return end_alone("The solve failed: ", error.what(), ExitCode::solve_failed);
      }
    catch (const OnOneRank<Interrupted> &error)
      {
        return end_alone("The run was ", error.what(), ExitCode::solve_failed);
      }
    catch (const SolveError &error)
      {
        err << "The solve failed: " << error.what() << "\n"
            << "What was computed before is in the output folder; run.log there tells how the steps went." << std::endl;
        return ExitCode::solve_failed;
      }
    catch (const Interrupted &error)
      {
        err << "The run was " << error.what() << std::endl;
        return ExitCode::solve_failed;
      }
    catch (const SystemError &error)
      {
        return end_alone("The system refused: ", error.what(), ExitCode::system_refused);
      }
    catch (const std::filesystem::filesystem_error &error)
      {
        return end_alone("The system refused: ", "cannot use " + error.path1().string() + ": " + error.code().message(),
                         ExitCode::system_refused);
      }
    catch (const std::bad_alloc &)
      {
        return end_alone("The system refused: ", "out of memory", ExitCode::system_refused);
      }
    catch (const std::exception &error)
      {
        return end_alone("Internal error: ", error.what(), ExitCode::internal_error);
      }
    catch (...)
      {
        return end_alone("Internal error: ", "what was thrown is no std::exception", ExitCode::internal_error);
      }
  }
} // namespace myolines
