"""The farm's own rooms and yards, each built from a seed: the backdrop behind the cables and the light on them."""
