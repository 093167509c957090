"""Pictures and movies of runs by the engine's software ray tracer, which needs no display."""

from support_exudyn.postprocessing.render.rendering import SIZE, STILL, Rendered, render, still

__all__ = ["SIZE", "STILL", "Rendered", "render", "still"]
