"""Build a material's shader tree in short calls."""

from typing import Any

import bpy


class Shader:
    """A material whose shader tree is being built.

    Attributes:
        material: Blender's material.
        surface: its principled shader, linked to the output until `put_out` replaces it.
        tint: node that reads a solid's tint.
    """

    def __init__(self, name: str) -> None:
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self._tree = self.material.node_tree
        self._tree.nodes.clear()
        self.surface = self.node("ShaderNodeBsdfPrincipled")
        self.tint = self.attribute("tint")
        self._output = self.node("ShaderNodeOutputMaterial")
        self.link(self.surface.outputs[0], self._output.inputs["Surface"])

    def node(self, kind: str, **settings: Any) -> Any:
        """Add a node of a kind, with the given settings."""
        node = self._tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def link(self, source: Any, target: Any) -> None:
        """Link an output to an input."""
        self._tree.links.new(source, target)

    def put_out(self, source: Any) -> None:
        """Show `source` in place of the principled shader."""
        self.link(source, self._output.inputs["Surface"])

    def attribute(self, name: str) -> Any:
        """Add a node that reads a mesh's attribute."""
        return self.node("ShaderNodeAttribute", attribute_name=name)

    def set(self, **values: Any) -> None:
        """Set inputs of the principled shader; an underscore in a name stands for a blank."""
        for name, value in values.items():
            self.surface.inputs[name.replace("_", " ").title().replace("Ior", "IOR")].default_value = value

    def noise(self, scale: float, stretch: tuple[float, float, float] = (1, 1, 1), detail: float = 3.0) -> Any:
        """Make noise from 0 to 1 along the solid's own axes.

        Args:
            scale: waves per metre.
            stretch: factors on the scale along the three axes.
            detail: number of finer octaves.
        """
        mapping = self.node("ShaderNodeMapping")
        mapping.inputs["Scale"].default_value = stretch
        self.link(self.attribute("local").outputs["Vector"], mapping.inputs["Vector"])
        noise = self.node("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value, noise.inputs["Detail"].default_value = scale, detail
        self.link(mapping.outputs[0], noise.inputs["Vector"])
        return noise.outputs["Fac"]

    def span(self, value: Any, low: float, high: float, start: float = 0.3, end: float = 0.7) -> Any:
        """Map a value linearly: `start` to `low`, `end` to `high`, clamped beyond."""
        node = self.node("ShaderNodeMapRange")
        for name, number in (("From Min", start), ("From Max", end), ("To Min", low), ("To Max", high)):
            node.inputs[name].default_value = number
        self.link(value, node.inputs["Value"])
        return node.outputs[0]

    def times(self, colour: Any, factor: Any) -> Any:
        """Multiply a colour by a number or by another colour."""
        node = self.node("ShaderNodeVectorMath", operation="MULTIPLY")
        self.link(colour, node.inputs[0])
        self.link(factor, node.inputs[1])
        return node.outputs[0]

    def mixed(self, factor: Any, first: Any, second: Any) -> Any:
        """Mix two colours: a factor of 0 shows `first`, 1 shows `second`, a socket or a linear colour."""
        node = self.node("ShaderNodeMix", data_type="RGBA")
        self.link(factor, node.inputs["Factor"])
        self.link(first, node.inputs[6])
        if isinstance(second, tuple):
            node.inputs[7].default_value = (*second, 1.0)
        else:
            self.link(second, node.inputs[7])
        return node.outputs[2]

    def colour(self, socket: Any) -> None:
        """Set the base colour."""
        self.link(socket, self.surface.inputs["Base Color"])

    def roughness(self, socket: Any) -> None:
        """Set the roughness."""
        self.link(socket, self.surface.inputs["Roughness"])

    def bump(self, height: Any, distance_m: float) -> None:
        """Add relief: a height of 0 to 1, where 1 stands for `distance_m` metres."""
        node = self.node("ShaderNodeBump")
        node.inputs["Distance"].default_value = distance_m
        self.link(height, node.inputs["Height"])
        self.link(node.outputs[0], self.surface.inputs["Normal"])

    def uv(self, scale: float) -> Any:
        """Scale the UV map to tiles; `scale` is tiles per metre (1 for pictures from the atlas)."""
        node = self.node("ShaderNodeMapping")
        node.inputs["Scale"].default_value = (scale, scale, scale)
        self.link(self.node("ShaderNodeUVMap", uv_map="uv").outputs[0], node.inputs["Vector"])
        return node.outputs[0]

    def image(self, image: Any, scale: float = 1.0) -> Any:
        """Read the colour of an image at the UV map, `scale` tiles per metre."""
        node = self.node("ShaderNodeTexImage", image=image)
        self.link(self.uv(scale), node.inputs["Vector"])
        return node.outputs["Color"]
