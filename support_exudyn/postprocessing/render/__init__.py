"""Pictures and movies of runs by the engine's software ray tracer, which needs no display."""

from support_exudyn.postprocessing.render.rendering import SIZE, Rendered, render, still

__all__ = ["SIZE", "Rendered", "render", "still"]
