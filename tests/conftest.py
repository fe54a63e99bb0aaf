"""What all tests share: what they name and run is remembered in a folder of their own."""

import os
import tempfile

os.environ["SOCIALMIND_DATA_DIR"] = tempfile.mkdtemp(prefix="socialmind-tests-")
