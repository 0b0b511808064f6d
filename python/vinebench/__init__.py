from vinebench import _load
_core = _load.load()
from vinebench._core import *
__version__ = _core.__version__
