"""Values typed while frames are long; the rest of the constants is tested without a window (tests/ui)."""

from cases import case, check, main
from sandbox import LEFT, centre, k_s


@case
def typed_fast(stage):
    """keys that fall into one long frame arrive all and in order: select all, digits, a backspace, Enter"""
    sandbox = stage.start("hanging")
    for keys, value in ((["ctrl+a", "5", "1", "Return"], 51), (["BackSpace", "6", "2", "Return"], 62),
                        (["ctrl+a", "7", "8", "BackSpace", "3", "Return"], 73)):
        sandbox.double_click(*centre(sandbox.control("constants.k_s.value")), LEFT, lambda r: r["typing"],
                             "a text field")
        sandbox.xdotool("key", "--delay", "4", *keys)
        sandbox.wait(lambda r: not r["typing"], "the text field to close")
        check(k_s(sandbox.report()) == value, f"{value} is taken, not {k_s(sandbox.report())}")


@case
def typed_held(stage):
    """a key still down at the end of a long frame acts in its turn, and once"""
    sandbox = stage.start("hanging")
    for value in (51, 62, 73):
        sandbox.double_click(*centre(sandbox.control("constants.k_s.value")), LEFT, lambda r: r["typing"],
                             "a text field")
        first, second = str(value)
        sandbox.xdotool("key", "--delay", "4", "ctrl+a", "8", "keydown", "BackSpace", "sleep", "0.1",
                        "keyup", "BackSpace", "key", "--delay", "4", first, second, "Return")
        sandbox.wait(lambda r: not r["typing"], "the text field to close")
        check(k_s(sandbox.report()) == value, f"{value} is taken, not {k_s(sandbox.report())}")


if __name__ == "__main__":
    main()
