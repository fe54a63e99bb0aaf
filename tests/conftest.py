"""What all tests share: a folder of their own for what is remembered, and no clock in examples."""

import gc
import os
import tempfile

from hypothesis import settings

os.environ["SOCIALMIND_DATA_DIR"] = tempfile.mkdtemp(prefix="socialmind-tests-")

# The first example of many compiles. `--hypothesis-profile=ci` draws the same examples each time.
settings.register_profile("unhurried", deadline=None)
if settings.get_current_profile_name() == "default":
    settings.load_profile("unhurried")


def pytest_collection_finish():
    # Ten thousand tests are not looked through each time that cycles are collected.
    gc.freeze()
