// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bindings.h"

#include <myolines/base/error.h>
#include <myolines/base/names.h>
#include <myolines/base/on_one_rank.h>

#include <filesystem>

namespace myolines
{
  namespace [[gnu::visibility("hidden")]] python
  {
    namespace
    {
      /// Raises the class @p name of myolines.errors.
      template <typename... Arguments>
      void raise_as(const char *name, const Arguments &...arguments)
      {
        const py::object type = py::module_::import("myolines.errors").attr(name);
        PyErr_SetObject(type.ptr(), type(arguments...).ptr());
      }

      py::list problems_of(const InputError &error)
      {
        const py::object problem = py::module_::import("myolines.errors").attr("Problem");
        py::list         list;
        for (const InputProblem &one : error.problems())
          list.append(problem(one.where, one.what, one.expected, one.hint));
        return list;
      }

      /// Whether other ranks do not know of it.
      bool is_on_one_rank(const std::exception &error)
      {
        return dynamic_cast<const OnOneRank<SolveError> *>(&error) != nullptr ||
               dynamic_cast<const OnOneRank<Interrupted> *>(&error) != nullptr;
      }

      void translate(const std::exception_ptr error)
      {
        try
          {
            if (error)
              std::rethrow_exception(error);
          }
        catch (const InputError &problem)
          {
            raise_as("InputError", problem.what(), problems_of(problem));
          }
        catch (const SolveError &problem)
          {
            raise_as("SolveError", problem.what(), is_on_one_rank(problem));
          }
        catch (const Interrupted &problem)
          {
            raise_as("Interrupted", problem.what(), is_on_one_rank(problem));
          }
        catch (const SystemError &problem)
          {
            raise_as("SystemRefused", problem.what(), problem.error_number());
          }
        catch (const std::filesystem::filesystem_error &problem)
          {
            raise_as("SystemRefused", "cannot use " + problem.path1().string() + ": " + problem.code().message(), problem.code().value());
          }
      }
    } // namespace

    void bind_errors(py::module_ &module)
    {
      py::register_exception_translator(translate);
      module.def(
          "refuse",
          [](const std::string &where, const std::string &what, const std::string &expected, const std::string &hint) {
            throw InputError(InputProblem{where, what, expected, hint});
          },
          py::arg("where"), py::arg("what"), py::arg("expected") = "", py::arg("hint") = "",
          "Raises InputError in the words of the program.");
      module.def("nearest_hint", &nearest_hint, py::arg("name"), py::arg("candidates"), py::arg("label"),
                 "The hint that names the nearest candidate; empty if none is near.");
    }
  } // namespace python
} // namespace myolines
