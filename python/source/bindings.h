// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <myolines/system/semi_discrete_system.h>

#include <string>

/// The module `myolines._core`: what the package in python/myolines needs of the library, one function for each file.
namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    namespace py = pybind11;
    using Array  = py::array_t<double, py::array::c_style | py::array::forcecast>;

    /// Errors of the library become those of myolines.errors, with the same texts.
    void bind_errors(py::module_ &module);
    void bind_scenes(py::module_ &module);
    void bind_runs(py::module_ &module);
    void bind_systems(py::module_ &module);
    void bind_simulations(py::module_ &module);
    void bind_methods(py::module_ &module);

    /// Starts MPI unless it has been started; it ends after the interpreter has let go of its objects.
    void need_mpi();

    /// Runs @p work without the lock of the interpreter, with which others may go on.
    template <typename Work>
    auto without_lock(const Work &work)
    {
      const py::gil_scoped_release release;
      return work();
    }

    /// A copy of the owned entries.
    inline Array owned(const Vector &x) { return Array(static_cast<py::ssize_t>(x.locally_owned_size()), x.begin()); }

    /// The owned entries themselves; @p owner keeps the vector alive.
    inline Array view(Vector &x, const py::handle owner)
    {
      return Array(static_cast<py::ssize_t>(x.locally_owned_size()), x.begin(), owner);
    }

    /// Sets the owned entries, and the ghosts. @throws py::value_error unless there are as many numbers.
    inline void assign(const Array &values, Vector &x)
    {
      if (values.ndim() != 1 || static_cast<std::size_t>(values.shape(0)) != x.locally_owned_size())
        throw py::value_error("an array of " + std::to_string(x.locally_owned_size()) +
                              " numbers is needed, one for each unknown of this rank");
      std::copy_n(values.data(), values.shape(0), x.begin());
      x.update_ghost_values();
    }

    /// "left" or "right".
    inline Side side_named(const std::string &name)
    {
      if (name != "left" && name != "right")
        throw py::value_error("the side of an instant is \"left\" or \"right\", not \"" + name + "\"");
      return name == "left" ? Side::left : Side::right;
    }
  } // namespace python
} // namespace myolines
