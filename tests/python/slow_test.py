"""Each recipe of docs/recipes runs, and writes its picture."""
import importlib.util
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["ROCKFOLD_SOURCE_DIR"])
RECIPES = sorted((SOURCE / "docs" / "recipes").glob("*.py"))


class RecipeTest(unittest.TestCase):
    def test_each_writes_its_picture(self):
        environment = dict(os.environ, MPLBACKEND="Agg", PYTHONPATH=str(SOURCE / "python"), ROCKFOLD=os.environ["ROCKFOLD_BINARY"])
        self.assertEqual(len(RECIPES), 10)
        for recipe in RECIPES:
            with self.subTest(recipe.name), tempfile.TemporaryDirectory() as folder:
                done = subprocess.run([sys.executable, "-B", recipe], cwd=folder, env=environment, capture_output=True, text=True, timeout=250)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(done.stdout.strip())
                self.assertGreater((Path(folder) / recipe.with_suffix(".png").name).stat().st_size, 10_000)


if __name__ == "__main__":
    if not all(importlib.util.find_spec(name) for name in ("matplotlib", "pandas")):
        print("needs matplotlib and pandas")
        sys.exit(77)
    unittest.main()
