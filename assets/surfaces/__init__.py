"""Procedural floor surfaces: recipes that draw seamless colour, roughness, normal and metallic maps."""
