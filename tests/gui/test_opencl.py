"""Cloths on an OpenCL device in a real window: what is copied for drawing; programs built beside the frames."""

import json
import os
import subprocess
import tempfile

from cases import case, check, main, skip


def costs(sandbox, engine, **environment):
    """What --time-report says of some frames on an engine; skips the case where that is not there."""
    out = os.path.join(sandbox.own.name, f"{engine}.json")
    done = subprocess.run([sandbox.tyglab, "hanging", "--engine", engine, "--frames", "20", "--time-report", out],
                          env={**sandbox.environment, **environment}, capture_output=True, text=True)
    check(done.returncode == 0, f"the window closed with exit code {done.returncode}: {done.stderr}")
    with open(out) as file:
        report = json.load(file)
    if engine == "opencl" and "OpenCL" not in report["engine"]:
        skip(f"there is no OpenCL device: {done.stderr}")
    return report


@case
def copied(stage):
    """the time report tells what is copied for drawing: nothing where a processor's kernels write OpenGL's memory"""
    sandbox = stage.start("hanging", "--engine", "opencl")
    sandbox.click_control("plots.Performance")
    sandbox.later(5)
    stage.keep("performance")
    on_cpu = costs(sandbox, "cpu")
    check(on_cpu["copied_bytes_per_frame"] >= 32 * 32 * 24, "the CPU engine's positions and normals are")
    check("main memory" in on_cpu["copied_because"], "and the report says why")
    on_device = costs(sandbox, "opencl")
    lacking = costs(sandbox, "opencl", MESA_EXTENSION_OVERRIDE="-GL_ARB_buffer_storage")
    check("ARB_buffer_storage" in lacking["copied_because"], "so it does where OpenGL lacks something")
    check("copied_because" not in on_device, "nothing is copied, and nothing is to be said")
    check(on_device["copied_bytes_per_frame"] == 0, f"{on_device['copied_bytes_per_frame']} bytes a frame are copied")
    check(on_device["positions_come_by"] == "shared_memory", "the report names the way")


@case
def shared_buffer(stage):
    """on a device that shares buffers with OpenGL (a double of one) the window's buffer is written"""
    double = os.path.join(os.path.dirname(stage.tyglab), "..", "tests", "libgl_sharing_double.so")
    if not os.path.exists(double):
        skip("the double of a graphics card has not been built; build gl_sharing_double")
    report = costs(stage.start("hanging"), "opencl", OPENCL_LAYERS=double)
    check(report["positions_come_by"] == "shared_buffer", f"positions come by {report['positions_come_by']}")
    check(report["copied_bytes_per_frame"] == 0, f"{report['copied_bytes_per_frame']} bytes a frame are copied")


@case
def programs(stage):
    """bending that is switched on on an OpenCL device comes with its program, and the cloth goes on until then"""
    on_device = ("hanging", "--engine", "opencl", "--set", "k_b=0")
    if subprocess.run([stage.tyglab, "run", *on_device, "--steps", "1"], capture_output=True).returncode != 0:
        skip("there is no OpenCL device")
    with tempfile.TemporaryDirectory() as nothing_built:
        caches = {"POCL_CACHE_DIR": nothing_built, "XDG_CACHE_HOME": nothing_built}
        sandbox = stage.start(*on_device, environment=caches)
        sandbox.wait(lambda r: r["t"] > 0.05 and r["building"] is None and r["preset"]["solver"]["engine"] == "opencl",
                     "the cloth to move on the device")
        before = sandbox.type_value("k_b", "3")
        report = sandbox.wait(lambda r: r["preset"]["forces"]["k_b"] == 3, "bending")
        check(report["frames_while_building"] >= 3, f"{report['frames_while_building']} frames were drawn meanwhile")
        check(report["t"] > before["t"] and report["building"] is None, "the cloth went on")
        check(not report["messages"], f"nothing was to be said, but: {report['messages']}")
        stage.keep("programs")
        sandbox.close()


if __name__ == "__main__":
    main()
