# SPDX-License-Identifier: LGPL-2.1-or-later
"""Requirement: the Python of doc/python.md runs, in its order, and prints what the page says."""

import contextlib
import io
import os
import re
import unittest

from common import ROOT, FolderTest


class Page(FolderTest):
    def test_page(self):
        with open(os.path.join(ROOT, "doc", "python.md"), encoding="utf-8") as stream:
            blocks = re.findall(r"^```(python|text)\n(.*?)^```", stream.read(), flags=re.M | re.S)
        self.assertGreater(len(blocks), 10)
        os.symlink(os.path.join(ROOT, "input"), self.place("input"))
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(self.folder)
        names, printed = {"__name__": "page"}, ""
        for kind, text in blocks:
            if kind == "text":
                self.assertEqual(printed, text)
                continue
            out = io.StringIO()
            with contextlib.redirect_stdout(out):
                exec(compile(text, "doc/python.md", "exec"), names)  # pylint: disable=exec-used
            printed = out.getvalue()


if __name__ == "__main__":
    unittest.main()
