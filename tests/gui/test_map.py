"""The map of stiffness against dt: filled by short runs beside the frames, a click goes there."""

import os

from cases import case, check, main
from sandbox import k_s


@case
def click(stage):
    """the map fills while the cloth moves; a click takes k_s and dt from it; M closes it and ends the work"""
    sandbox = stage.start("hanging", "--set", "rows=13", "--set", "columns=13")
    sandbox.key("m")
    x, y, width, height = sandbox.control("plots.map")
    report = sandbox.wait(lambda r: r["map_cells"] and r["map_cells"] > 60, "cells to be measured")
    at = report["t"]
    sandbox.wait(lambda r: r["map_cells"] > 140 and r["t"] > at, "a quarter of the map, while the cloth moves on")
    sandbox.rest()
    stage.keep("filling")
    sandbox.move(x + 0.8 * width, y + 0.2 * height)
    sandbox.later(60)
    stage.keep("words")
    sandbox.click(x + 0.8 * width, y + 0.2 * height)
    report = sandbox.wait(lambda r: k_s(r) > 200 and r["preset"]["solver"]["dt"] > 0.003, "the values there")
    sandbox.wait(lambda r: r["divergence"] is not None, "what the map foretold: it diverges")
    sandbox.click(x + 0.3 * width, y + 0.9 * height)
    sandbox.wait(lambda r: k_s(r) < 50 and r["preset"]["solver"]["dt"] < 0.001, "values that are stable")
    sandbox.key("m")
    sandbox.wait(lambda r: r["map_cells"] is None, "the map to be gone")


@case
def csv(stage):
    """the map is written as CSV"""
    sandbox = stage.start("one_weight")
    sandbox.key("space")  # while nothing moves the frames leave the processors to the map
    sandbox.wait(lambda r: r["paused"], "the pause")
    sandbox.key("m")
    sandbox.wait(lambda r: r["map_cells"] == 28 * 20, "the map of one weight")
    stage.keep("weight")
    sandbox.click_control("plots.csv_map")
    file = sandbox.write_export("map.csv")
    with open(file) as written:
        lines = written.read().splitlines()
    check(lines[1] == "k [N/m],dt [s],outcome,t [s],energy error,dt by theory [s]", "a header with units")
    check(len(lines) == 2 + 28 * 20, "a row a cell")


@case
def png(stage):
    """the map is written as a picture, and the window goes on as before"""
    sandbox = stage.start("hanging")
    sandbox.key("m")
    sandbox.wait(lambda r: r["map_cells"] and r["map_cells"] > 100, "cells to be measured")
    sandbox.click_control("plots.png_map")
    file = sandbox.write_export("map.png")
    report = sandbox.wait(lambda r: any("map.png" in m for m in r["messages"]), "it to be written")
    with open(file, "rb") as written:
        head = written.read(24)
    check(head[:8] == b"\x89PNG\r\n\x1a\n", "it is a PNG")
    check(int.from_bytes(head[16:20], "big") == 1280 and int.from_bytes(head[20:24], "big") == 800, "of the charts' size")
    os.replace(file, os.path.join(stage.shots, "map-png-written.png"))
    sandbox.wait(lambda r: r["t"] > report["t"] + 0.2, "the cloth to move on")
    stage.keep("after")


if __name__ == "__main__":
    main()
