"""How figures look: numbers on axes are those of texts."""

from socialmind.drawing import style


def written(axes):
    """The numbers along an axis, once the figure is drawn."""
    axes.get_figure(root=True).draw_without_rendering()
    return [label.get_text() for label in axes.get_xticklabels()]


def panel(*limits):
    axes = style.figure(90, 60).subplots()
    axes.set_xlim(*limits)
    return axes


def test_thousands_have_commas():
    axes = panel(-2000, 2000)
    axes.set_xticks([-2000, -500, 0, 2000])
    assert written(axes) == ["−2,000", "−500", "0", "2,000"]
    axes.set_xticks([1234.5, 1500.0])
    assert written(axes) == ["1,234.5", "1,500.0"]


def test_small_numbers_and_steps_beside_an_offset_stay():
    axes = panel(0, 0.001)
    axes.set_xticks([0.0005, 0.00055])
    assert written(axes) == ["0.00050", "0.00055"]
    axes = panel(0, 2e7)
    axes.set_xticks([1e7, 2e7])
    assert written(axes) == ["1", "2"] and axes.xaxis.get_offset_text().get_text() == "1e7"


def test_insets_and_panels_of_parts_have_them_too():
    whole = style.figure(90, 60)
    left, right = whole.subfigures(1, 2)
    shared = left.subplots(2, 1, sharex=True)
    inset = right.subplots().inset_axes((0.5, 0.5, 0.5, 0.5))
    for axes in (shared[1], inset):
        axes.set_xlim(0, 3000)
        axes.set_xticks([3000])
        assert written(axes) == ["3,000"]


def test_what_somebody_chose_stays():
    axes = panel(0, 3000)
    axes.set_xticks([3000])
    axes.xaxis.set_major_formatter("{x:.0f} m")
    assert written(axes) == ["3000 m"]
    axes = panel(0, 3e6)
    axes.set_xticks([3e6])
    axes.ticklabel_format(style="plain")
    assert written(axes) == ["3,000,000"]
    axes.set_xscale("log")
    axes.set_xlim(1, 1e4)
    assert all("10" in one for one in written(axes) if one)
