"""The leak off the Hess manifold and the bridge."""

from hess_explorer.scenes import scenes

LEAK, BRIDGE = scenes()["hess-leak"], scenes()["bridge"]
