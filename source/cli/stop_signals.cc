// SPDX-License-Identifier: LGPL-2.1-or-later
#include <myolines/cli/stop_signals.h>

namespace myolines
{
  namespace
  {
    // A signal handler can reach nothing but what is global.
    volatile std::sig_atomic_t last_signal = 0;

    extern "C" void note_signal(const int number) { last_signal = number; }
  } // namespace

  StopSignals::StopSignals()
  {
    last_signal = 0;
    struct sigaction action
    {
    };
    action.sa_handler = note_signal;
    struct sigaction ignore
    {
    };
    ignore.sa_handler = SIG_IGN;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        sigaction(numbers[i], nullptr, &before_[i]);
        const bool ignored = numbers[i] == SIGPIPE || (numbers[i] == SIGHUP && before_[i].sa_handler == SIG_IGN);
        action.sa_flags    = SA_RESTART | (numbers[i] == SIGXCPU ? 0 : static_cast<int>(SA_RESETHAND)); // it comes every second
        sigaction(numbers[i], ignored ? &ignore : &action, nullptr);
      }
  }

  StopSignals::~StopSignals()
  {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      sigaction(numbers[i], &before_[i], nullptr);
  }

  int StopSignals::noted() const { return last_signal; }
} // namespace myolines
