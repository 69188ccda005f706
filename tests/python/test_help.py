# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: help is complete, and the stub names what the module has, no more and no less."""

import ast
import inspect
import os
import pydoc
import unittest

import myolines
from myolines import _core

PACKAGE = os.path.dirname(myolines.__file__)


def public(thing):
    return [name for name in vars(thing) if not name.startswith("_")]


class Help(unittest.TestCase):
    def test_everything_has_words(self):
        for name in myolines.__all__:
            thing = getattr(myolines, name)
            if inspect.isclass(thing) and thing.__module__.startswith("myolines"):
                self.assertTrue(inspect.getdoc(thing), name)
                for member in public(thing):
                    value = inspect.getattr_static(thing, member)
                    if inspect.isfunction(value) or isinstance(value, (property, classmethod, staticmethod)):
                        words = inspect.getdoc(value.__func__ if isinstance(value, (classmethod, staticmethod)) else value)
                        self.assertTrue(words or thing.__module__ == "myolines.fit", f"{name}.{member}")
            elif inspect.isfunction(thing):
                self.assertTrue(inspect.getdoc(thing), name)
        text = pydoc.plain(pydoc.render_doc(myolines))
        self.assertIn("Simulation", text)

    def test_functions_have_types(self):
        for name in myolines.__all__:
            thing = getattr(myolines, name)
            functions = [value for value in vars(thing).values() if inspect.isfunction(value)] if inspect.isclass(thing) else [thing]
            for function in functions:
                if inspect.isfunction(function) and function.__module__.startswith("myolines") and not function.__name__.startswith("_"):
                    if function.__qualname__ in ("Integrator.start", "Integrator.step"):
                        continue
                    self.assertIn("return", function.__annotations__, function.__qualname__)

    def test_the_stub_is_the_module(self):
        self.assertTrue(os.path.exists(os.path.join(PACKAGE, "py.typed")))
        with open(os.path.join(PACKAGE, "_core.pyi")) as stream:
            tree = ast.parse(stream.read())
        stub = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        stub.update({node.target.id: node for node in tree.body if isinstance(node, ast.AnnAssign) and node.target.id != "__file__"})
        self.assertEqual(sorted(stub), sorted(public(_core)))
        for name, node in stub.items():
            if isinstance(node, ast.ClassDef):
                members = {part.name for part in node.body if isinstance(part, ast.FunctionDef) and part.name != "__init__"}
                members |= {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
                self.assertEqual(sorted(members), sorted(public(getattr(_core, name))), name)


if __name__ == "__main__":
    unittest.main()
