"""Things with keys, as a studio has them."""


def key(frame, *value, ease="linear", **slopes):
    return {"frame": frame, "value": list(value), "ease": ease, **slopes}


def channels():
    """A walker with three parts, of which one lies on a spline, and a camera."""
    parts = [{"name": "place", "axes": ["x", "y", "z"], "keys": [key(0, 0, 0, 0), key(40, 2, 0, 0)]},
             {"name": "left-shin", "axes": ["y"], "keys": [key(0, 10), key(20, 50, ease="spline"), key(40, 30, ease="spline"), key(60, 0)]},
             {"name": "head", "axes": ["x", "y", "z"], "keys": [key(20, 0, 0, 30, ease="both"), key(60, 0, 0, 0)]}]
    return [{"thing": "camera", "kind": "camera", "parts": [{"name": "eye", "axes": ["x", "y", "z"], "keys": [key(0, 6, -4, 3), key(60, 2, -4, 3)]}]},
            {"thing": "walker", "kind": "actor", "parts": parts}]
