// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <myolines/output/output_folder.h>
#include <myolines/scene/scene.h>
#include <myolines/time/loop.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace myolines
{
  /// State at @p t between @p begin and @p end: u is the cubic that has u and v of both (error of fourth order in the step), v its
  /// derivative, a the line between both. An interpolated displacement violates the volume constraint of nearly incompressible
  /// bodies: no stresses or reactions of it mean anything.
  ///
  /// Without inertia velocities are no derivatives of u at the ends of steps: u is then the line between both, v its slope.
  State interpolate(const State &begin, const State &end, double t, bool inertia);

  /// The first of some instants from a time on [s]; infinity if there is none.
  using Instants = std::function<double(double from)>;
  Instants multiples_of(double interval);           ///< 0, interval, 2 interval, ... [s]
  Instants instants(std::vector<double> ascending); ///< those of the list [s]

  /// Writes at instants that have nothing to do with the steps, and changes none of these.
  class DenseOutput : public Observer
  {
  public:
    /// @p name for what is saved; @p inertia: of the system.
    DenseOutput(Instants instants, std::string name, const OutputFolder &folder, bool inertia);

    void begin(const State &state) final;
    void resume(const State &state, std::size_t) final;
    void restarted(const State &state) final { last_ = state; }
    void accepted(const State &state, const StepRecord &record) final;
    void measure(const State &state, Side) final { write(state.t, state); }
    void save(Archive &archive) const override { archive.put(name_, written_); }

  protected:
    virtual void write(double t, const State &state) = 0; ///< @p state is that at the instant @p t

  private:
    double after(double t) const; ///< the first instant behind @p t

    const Instants    first_from_;
    const std::string name_;
    const bool        inertia_;
    double            next_    = 0;
    double            written_ = std::numeric_limits<double>::lowest(); ///< the last instant so far
    State             last_;
  };

  /// Parameters of the list `motion` with the @p content of its file.
  scene::Schema motion_schema(const std::string &content);

  /// motion.csv: time and what @p values makes of the state, named by @p columns, at the multiples of `interval` of the list @p motion.
  std::unique_ptr<Observer> make_motion(const scene::Node &motion, std::vector<std::string> columns,
                                        std::function<std::vector<double>(const State &)> values, const OutputFolder &folder, bool inertia);
} // namespace myolines
