"""Images an hour of a whole farm on this machine, by how its cores are shared out."""
