"""The client of tests/service, for scripts outside the tree that look for it here."""
import importlib.util
import pathlib

_FILE = pathlib.Path(__file__).parents[1] / "service" / "service_client.py"
_SPEC = importlib.util.spec_from_file_location("acinus_service_client", _FILE)
_MODULE = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(_MODULE)
globals().update({name: value for name, value in vars(_MODULE).items() if not name.startswith("_")})
