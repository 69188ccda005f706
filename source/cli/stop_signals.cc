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
    action.sa_flags   = SA_RESTART | static_cast<int>(SA_RESETHAND);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      sigaction(numbers[i], &action, &before_[i]);
  }

  StopSignals::~StopSignals()
  {
    for (std::size_t i = 0; i < numbers.size(); ++i)
      sigaction(numbers[i], &before_[i], nullptr);
  }

  int StopSignals::noted() const { return last_signal; }
} // namespace myolines
