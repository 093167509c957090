"""What the study `scene_detail` found out, as a table that `recommend` reads."""
