"""The tools with which recipes draw: noise, shapes, layouts, lettering."""
