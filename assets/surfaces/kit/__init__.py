"""What recipes draw with: noise, shapes, layouts, lettering."""
