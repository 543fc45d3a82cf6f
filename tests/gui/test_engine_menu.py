"""The menu of engines and precisions: what can be chosen, what cannot and why, what comes along."""

import os
import shutil
import tempfile

from cases import case, check, main
from sandbox import centre

MODES = ("cpu_float", "cpu_double", "opencl_float", "opencl_double")
NO_DEVICE = {"OCL_ICD_VENDORS": "/nonexistent"}


def open_menu(sandbox):
    sandbox.click_control("top.engine")
    return {mode: sandbox.control(f"menu.{mode}") for mode in MODES}


def solver(report):
    return report["preset"]["solver"]


@case
def without_device(stage):
    """where there is no OpenCL device its entries are grey, say why, and cannot be chosen"""
    sandbox = stage.start("hanging", environment=NO_DEVICE)
    sandbox.key("space")
    boxes = open_menu(sandbox)
    sandbox.later(30)
    for mode in ("opencl_float", "opencl_double"):
        sandbox.click(*centre(boxes[mode]))
        report = sandbox.later(5)
        check(solver(report)["engine"] == "cpu" and not report["messages"], f"{mode} cannot be chosen")
        check(f"menu.{mode}" in report["controls"], "the menu stays open")
    sandbox.move(*centre(boxes["opencl_float"]))
    sandbox.later(40)
    stage.keep("why")
    sandbox.move(*centre(boxes["cpu_double"]))
    sandbox.later(40)
    stage.keep("cpu")
    sandbox.click(*centre(boxes["cpu_double"]))
    sandbox.wait(lambda r: solver(r)["precision"] == "double", "double to be chosen")


@case
def with_device(stage):
    """an engine chosen by the menu and the palette; a method of the CPU engine alone brings that along"""
    sandbox = stage.start("hanging")
    sandbox.key("space")
    boxes = open_menu(sandbox)
    sandbox.later(30)
    sandbox.move(*centre(boxes["opencl_double"]))
    sandbox.later(40)
    stage.keep("opencl")
    sandbox.click(*centre(boxes["opencl_float"]))
    report = sandbox.later(5)
    if "menu.opencl_float" in report["controls"]:
        print("        there is no OpenCL device here: nothing more is tried")
        return
    sandbox.wait(lambda r: solver(r)["engine"] == "opencl" and not r["building"], "the OpenCL engine")
    sandbox.click_control("plots.Copies")
    for n, copy in enumerate(("Reference_Dormand_Prince_error_1e_9_m_per_step", "XPBD"), 1):
        sandbox.click_control("plots.add")
        sandbox.click_control("menu." + copy)
        report = sandbox.wait(lambda r: len(r["copies"]) == n, f"the copy {copy}")
        check(not report["messages"], "nothing speaks against it")
    sandbox.key("space")
    sandbox.wait(lambda r: r["t"] > 0.3 and all(c["t"] > 0.25 for c in r["copies"]), "them to move with the original")
    sandbox.key("space")
    sandbox.key("ctrl+p")
    sandbox.wait(lambda r: r["palette"] and r["typing"], "the palette")
    sandbox.later(3)
    sandbox.type("xpbd")
    sandbox.later(4)
    sandbox.key("Return")
    report = sandbox.wait(lambda r: solver(r)["integrator"] == "xpbd" and r["messages"], "the method, and a note")
    check(solver(report)["engine"] == "cpu", "the CPU engine came with it")
    check(report["messages"] == ["XPBD runs only on the CPU engine, so that engine was chosen."], str(report["messages"]))
    stage.keep("note")
    sandbox.key("ctrl+z")
    sandbox.wait(lambda r: solver(r)["integrator"] != "xpbd" and solver(r)["engine"] == "opencl", "one undo to take both back")


@case
def dying_driver(stage):
    """where the OpenCL driver dies late, here for want of a linker, the CPU engine goes on with a sentence"""
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(shutil.which("xdotool"), os.path.join(folder, "xdotool"))
        own = {"PATH": folder, "HOME": folder, "XDG_CACHE_HOME": "", "POCL_CACHE_DIR": os.path.join(folder, "pocl")}
        sandbox = stage.start("hanging", "--engine", "opencl", environment=own)
        report = sandbox.wait(lambda r: r["t"] > 0.1, "it to move")
        if solver(report)["engine"] == "opencl":
            print("        this OpenCL driver needs no linker: nothing more is tried")
            return
        check(any(text.endswith("The CPU engine runs it instead.") for text in report["messages"]),
              str(report["messages"]))
        stage.keep("took_over")


if __name__ == "__main__":
    main()
