"""What takes long is built beside the frames: the window goes on meanwhile."""

import json
import os
import subprocess
import tempfile

from cases import case, check, main

LARGE = 2048


def large_preset(sandbox):
    file = os.path.join(sandbox.own.name, "large.json")
    with open(file, "w") as out:
        json.dump({"tyglab_preset": 1, "name": "Large cloth", "cloth": {"rows": LARGE, "columns": LARGE, "L": 0.0005}}, out)
    return file


@case
def frames_go_on(stage):
    """while a cloth of 2048 x 2048 is built, frames of the present one go on"""
    sandbox = stage.start("hanging")
    file = large_preset(sandbox)
    sandbox.key("ctrl+o")
    sandbox.wait(lambda r: r["dialog"] == "open", "the open dialog")
    sandbox.click_control("dialog.path")
    sandbox.key("ctrl+a")
    sandbox.later(2)
    sandbox.type(file)
    sandbox.later(4)
    before = sandbox.report()
    sandbox.click_control("dialog.Open")
    report = sandbox.wait(lambda r: r["label"] == "large", "the large cloth")
    beside = report["frames_while_building"] - before["frames_while_building"]
    check(beside >= 3, f"{beside} frames were drawn while it was built")
    check(report["preset"]["cloth"]["rows"] == LARGE and report["building"] is None, "it is the one that was asked for")
    check(not report["unsaved"], "as it stands in its file")
    stage.keep("large")


@case
def programs(stage):
    """bending that is switched on on an OpenCL device comes with its program, and the cloth goes on until then"""
    on_device = ("hanging", "--engine", "opencl", "--set", "k_b=0")
    if subprocess.run([stage.tyglab, "run", *on_device, "--steps", "1"], capture_output=True).returncode != 0:
        print("not tested: there is no OpenCL device here", flush=True)
        return
    with tempfile.TemporaryDirectory() as nothing_built:
        os.environ["POCL_CACHE_DIR"] = os.environ["XDG_CACHE_HOME"] = nothing_built
        sandbox = stage.start(*on_device)
        sandbox.wait(lambda r: r["t"] > 0.05, "the cloth to move on the device")
        before = sandbox.type_value("k_b", "3")
        report = sandbox.wait(lambda r: r["preset"]["forces"]["k_b"] == 3, "bending")
        check(report["frames_while_building"] >= 3, f"{report['frames_while_building']} frames were drawn meanwhile")
        check(report["t"] > before["t"] and report["building"] is None, "the cloth went on")
        check(not report["messages"], f"nothing was to be said, but: {report['messages']}")
        stage.keep("programs")
        sandbox.close()
    del os.environ["POCL_CACHE_DIR"], os.environ["XDG_CACHE_HOME"]


def costs(sandbox, engine, **environment):
    """What --time-report says of some frames on an engine; None where it is not there."""
    out = os.path.join(sandbox.own.name, f"{engine}.json")
    done = subprocess.run([sandbox.tyglab, "hanging", "--engine", engine, "--frames", "20", "--time-report", out],
                          env={**sandbox.environment, **environment}, capture_output=True, text=True)
    if done.returncode != 0:
        return None
    with open(out) as file:
        return json.load(file)


@case
def copied(stage):
    """the time report tells what is copied for drawing: nothing where a processor's kernels write OpenGL's memory"""
    sandbox = stage.start("hanging", "--engine", "opencl")
    sandbox.wait(lambda r: "plots.Performance" in r["controls"], "the Performance card")
    sandbox.click_control("plots.Performance")
    sandbox.later(5)
    stage.keep("performance")
    on_cpu = costs(sandbox, "cpu")
    check(on_cpu["copied_bytes_per_frame"] >= 32 * 32 * 24, "the CPU engine's positions and normals are")
    check("main memory" in on_cpu["copied_because"], "and the report says why")
    on_device = costs(sandbox, "opencl")
    if "OpenCL" in on_device["engine"]:
        lacking = costs(sandbox, "opencl", MESA_EXTENSION_OVERRIDE="-GL_ARB_buffer_storage")
        check("ARB_buffer_storage" in lacking["copied_because"], "so it does where OpenGL lacks something")
        check("copied_because" not in on_device, "nothing is copied, and nothing is to be said")
        check(on_device["copied_bytes_per_frame"] == 0, f"{on_device['copied_bytes_per_frame']} bytes a frame are copied")
        check(on_device["positions_come_by"] == "shared_memory", "the report names the way")


@case
def shared_buffer(stage):
    """on a device that shares buffers with OpenGL (a double of one) the window's buffer is written, and closed cleanly"""
    double = os.path.join(os.path.dirname(stage.tyglab), "..", "tests", "libgl_sharing_double.so")
    if not os.path.exists(double):
        print("not tested: the double of a graphics card has not been built", flush=True)
        return
    sandbox = stage.start("hanging")
    report = costs(sandbox, "opencl", OPENCL_LAYERS=double)
    check(report is not None, "the window closed without a complaint of the double")
    if "OpenCL" in report["engine"]:
        check(report["positions_come_by"] == "shared_buffer", f"positions come by {report['positions_come_by']}")
        check(report["copied_bytes_per_frame"] == 0, f"{report['copied_bytes_per_frame']} bytes a frame are copied")


@case
def automatic(stage):
    """"Automatic" in the engine's menu takes the engine that is quickest, and says why"""
    sandbox = stage.start("hanging")
    sandbox.click_control("top.engine")
    sandbox.control("menu.automatic_engine")
    stage.keep("menu")
    sandbox.click_control("menu.automatic_engine")
    report = sandbox.wait(lambda r: any(text.startswith("Automatic: ") for text in r["messages"]), "a choice")
    stage.keep("chosen")
    why = next(text for text in report["messages"] if text.startswith("Automatic: "))
    chosen = "cpu" if why.startswith("Automatic: the CPU engine") else "opencl"
    report = sandbox.wait(lambda r: r["preset"]["solver"]["engine"] == chosen and r["building"] is None, f"engine {chosen}")
    sandbox.wait(lambda r: r["t"] > report["t"], "the cloth to go on")


if __name__ == "__main__":
    main()
