"""The model in space: sections of a bearing, joints, what is observed."""
