"""Names of the things that the farm looks for in a template. An artist may change everything else."""

from typing import Final

PICTURE_SCENE: Final = "picture"
"""The scene that is rendered, in metres."""

CABLE: Final = "cable"
"""The cable that every rendered cable is a copy of, and its material."""

SKIN: Final = "skin"
"""The material of cables whose sheath is drawn as images, and of what comes out of a sheath."""

FLOOR: Final = "floor"
"""The floor of the picture, and its material."""

CAMERA: Final = "camera"
POINT_LAMP: Final = "point_lamp"
AREA_LAMP: Final = "area_lamp"
WORLD: Final = "world"

CABLE_COLOUR_RAMP: Final = "dirt ramp"
CABLE_REFLECTION_RAMP: Final = "reflection ramp"
CABLE_MAPPING: Final = "dirt mapping"
CABLE_NOISE: Final = "dirt noise"

SKIN_COLOUR: Final = "skin colour"
SKIN_ROUGHNESS: Final = "skin roughness"
SKIN_NORMAL: Final = "skin normal"
SKIN_SURFACE: Final = "skin surface"

FLOOR_COLOUR: Final = "floor colour"
FLOOR_ROUGHNESS: Final = "floor roughness"
FLOOR_METALLIC: Final = "floor metallic"
FLOOR_NORMAL: Final = "floor normal"

WORLD_SWITCH: Final = "hdri or grey"
WORLD_BRIGHTNESS: Final = "hdri brightness"
WORLD_MAPPING: Final = "hdri mapping"
WORLD_IMAGE: Final = "hdri image"
WORLD_GREY: Final = "grey"
