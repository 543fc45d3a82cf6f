"""Themes: dark, light, and one for projectors."""

from cases import case, check, main


@case
def themes(stage):
    """Ctrl+T goes through the themes; the last one is there again in the next session"""
    sandbox = stage.start("hanging")
    sandbox.wait(lambda r: r["t"] > 0.4, "the cloth to hang")
    check(sandbox.report()["theme"] == "dark", "dark at first")
    sandbox.key("ctrl+t")
    sandbox.wait(lambda r: r["theme"] == "light", "light")
    sandbox.rest()
    light = stage.keep("light")
    check(sum(light.pixel(5, 400)) > 600, "the panels are light")
    sandbox.key("ctrl+t")
    sandbox.wait(lambda r: r["theme"] == "projector", "projector")
    sandbox.later(10)
    stage.keep("projector")
    sandbox.key("ctrl+q")
    check(sandbox.ended() == 0, "it ends well")
    again = stage.start("hanging", config=sandbox.config)
    check(again.report()["theme"] == "projector", "the theme is remembered")
    again.key("ctrl+t")
    again.wait(lambda r: r["theme"] == "dark", "round to dark")


if __name__ == "__main__":
    main()
