from .library.exploring import explore
from .library.own_scene import scene
from .library.state import SceneState, from_link, state

__all__ = ["SceneState", "explore", "from_link", "scene", "state"]
