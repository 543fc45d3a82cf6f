"""The tour at the first start."""

import json

from cases import case, check, main


@case
def tour(stage):
    """the first start shows the tour; it can be walked through, skipped and seen again"""
    sandbox = stage.start(tour_seen=False)
    report = sandbox.wait(lambda r: r["tour"] == 0, "the first card")
    for card in range(5):
        sandbox.wait(lambda r: r["tour"] == card, f"card {card + 1}")
        sandbox.later(4)
        stage.keep(f"card-{card + 1}")
        if card < 4:
            sandbox.click_control("tour.Next")
    sandbox.click_control("tour.Back")
    sandbox.wait(lambda r: r["tour"] == 3, "the card before")
    sandbox.key("Return")
    sandbox.key("Return")
    sandbox.wait(lambda r: r["tour"] == -1, "the end of the tour")
    sandbox.key("F1")
    sandbox.click_control("help.Take_the_tour")
    sandbox.wait(lambda r: r["tour"] == 0, "the tour again")
    sandbox.click_control("tour.Skip_the_tour")
    sandbox.wait(lambda r: r["tour"] == -1, "it to be skipped")
    sandbox.key("F1")
    sandbox.later(4)
    stage.keep("help")
    sandbox.key("Escape")
    sandbox.press_close_button()
    check(sandbox.ended() == 0, "it ends")
    with open(sandbox.settings_file) as file:
        check(json.load(file)["tour_seen"], "that it was seen is remembered")


@case
def once(stage):
    """who has seen the tour, or names a preset, does not get it"""
    sandbox = stage.start()
    check(sandbox.later(6)["tour"] == -1, "it was seen before")
    sandbox.key("ctrl+q")
    sandbox.ended()
    sandbox = stage.start("hanging", tour_seen=False)
    check(sandbox.later(6)["tour"] == -1, "a preset was named")


if __name__ == "__main__":
    main()
