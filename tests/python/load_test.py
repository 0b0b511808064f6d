# SPDX-FileCopyrightText: Vinebench authors
# SPDX-License-Identifier: Apache-2.0
"""How the extension is loaded: with the program's arithmetic, and nothing else in the process
changed."""
import json
import os
import subprocess
import sys
import unittest

import vinebench as vb
from support import PROGRAM, ROOT, CourtTest, main


def in_python(code, *options):
    return subprocess.run([sys.executable, *options, "-c", code], capture_output=True, text=True)


class LoadTest(CourtTest):
    def test_it_computes_as_the_program(self):
        told = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout
        for name in ("libm", "shaders", "blas"):
            self.assertRegex(told, rf"(?m)^  {name} +{vb.arithmetic()[name].replace('.', '[.]')}$")

    def test_pythons_own_functions_stay(self):
        code = ("import math, numpy\nvalues = [math.sin(i / 7) for i in range(10**4)]\n"
                "arrays = numpy.exp(numpy.arange(1000) / 7)\nimport vinebench\n"
                "assert values == [math.sin(i / 7) for i in range(10**4)]\n"
                "assert (arrays == numpy.exp(numpy.arange(1000) / 7)).all()\n")
        done = in_python(code)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_library_that_was_loaded_before_is_told(self):
        code = ("import ctypes, json, warnings\nctypes.CDLL('libopencv_core.so.406')\n"
                "with warnings.catch_warnings(record=True) as told:\n"
                "    warnings.simplefilter('always')\n    import vinebench\n"
                "print(json.dumps([str(w.message) for w in told]))\n"
                "print(json.dumps(vinebench.arithmetic()))\n")
        done = in_python(code)
        if "cannot open shared object file" in done.stderr:
            self.skipTest("another version of OpenCV")
        told, arithmetic = map(json.loads, done.stdout.splitlines())
        self.assertRegex(told[0], "libopencv_core.*loaded before vinebench")
        self.assertIn("glibc", arithmetic["libm"])
        self.assertNotIn("vinebench", arithmetic["libm"])

    def test_preloaded_libraries_are_left_first(self):
        code = "import json, vinebench\nprint(json.dumps(vinebench.arithmetic()))"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                              env={**os.environ, "LD_PRELOAD": "libm.so.6"})
        self.assertTrue(json.loads(done.stdout)["libm"].startswith("glibc"), done.stderr)

    def test_names_have_documentation(self):
        for name in vb.__all__:
            if not name.startswith("_") and name != "label_names":
                self.assertTrue((getattr(vb, name).__doc__ or "").strip(), name)

    def test_the_types_hold(self):
        done = in_python("import mypy")
        if done.returncode != 0:
            self.skipTest("mypy is not installed")
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports",
                               "--cache-dir", self.folder / "mypy", ROOT / "python/vinebench"],
                              capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stdout)

    # Names and parameters of the stub against those of the extension.
    def test_the_stub_has_what_the_extension_has(self):
        import ast
        from vinebench import _core
        tree = ast.parse((ROOT / "python/vinebench/_core.pyi").read_text())
        for node in tree.body:
            if isinstance(node, ast.FunctionDef):
                self.assertIn(node.name, dir(_core))
            if isinstance(node, ast.ClassDef) and hasattr(_core, node.name):
                for member in node.body:
                    if isinstance(member, ast.FunctionDef):
                        self.assertIn(member.name, dir(getattr(_core, node.name)), node.name)


if __name__ == "__main__":
    main()
