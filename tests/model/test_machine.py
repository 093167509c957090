from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from support_exudyn import Body, Crank, LinearActuator, Linkage, Machine, Part, PinPlace, Slide, TracePoint
from support_exudyn.model.linkage import bar, lumped, pinned
from user_forces import InputError, Value, value

coordinates = st.floats(-10.0, 10.0)
points = st.tuples(coordinates, coordinates)
masses = st.floats(0.1, 1000.0)
parts = st.builds(Part, mass=masses, centre=points, inertia=st.floats(0.0, 1000.0))
BODY = Body(mass=2.0, inertia=0.1, centre=(0.0, 0.0))


def test_bar_has_the_inertia_of_a_slender_rod() -> None:
    rod = bar(12.0, (1.0, 1.0), (4.0, 5.0))
    assert rod.centre == (2.5, 3.0)
    # m l^2 / 12 with l = 5; rounding
    assert rod.inertia == pytest.approx(25.0, rel=1e-15)


@given(mass=masses, a=points, b=points, share=st.floats(0.05, 0.95))
def test_a_bar_cut_in_two_is_the_same_lump(
    mass: float, a: tuple[float, float], b: tuple[float, float], share: float
) -> None:
    cut = (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]))
    whole, halves = bar(mass, a, b), lumped([bar(share * mass, a, cut), bar((1 - share) * mass, cut, b)])
    # rounding of sums of coordinates up to 10 and of their squares
    assert halves.mass == pytest.approx(mass, rel=1e-14)
    assert halves.centre == pytest.approx(whole.centre, abs=1e-13)
    assert halves.inertia == pytest.approx(whole.inertia, abs=1e-12 * mass)


def test_two_point_masses_are_a_dumbbell() -> None:
    dumbbell = lumped([Part(mass=1.0, centre=(0.0, 0.0)), Part(mass=3.0, centre=(4.0, 0.0))])
    assert dumbbell.mass == 4.0
    assert dumbbell.centre == (3.0, 0.0)
    # reduced mass 3/4 times 4^2
    assert dumbbell.inertia == 12.0


@given(items=st.lists(parts, min_size=1, max_size=5), about=points)
def test_inertia_about_any_point_is_the_sum_over_the_parts(
    items: list[Part], about: tuple[float, float]
) -> None:
    def inertia(part: Part) -> float:
        x, y = part.centre
        return part.inertia + part.mass * ((x - about[0]) ** 2 + (y - about[1]) ** 2)

    # rounding of sums of positive numbers
    assert inertia(lumped(items)) == pytest.approx(sum(map(inertia, items)), rel=1e-12)


@given(items=st.lists(parts, min_size=1, max_size=5))
def test_first_moment_is_the_sum_over_the_parts(items: list[Part]) -> None:
    lump = lumped(items)
    # rounding, relative to all masses at coordinates of 10
    scale = 1e-14 * 10.0 * lump.mass
    assert lump.mass * lump.centre[0] == pytest.approx(sum(p.mass * p.centre[0] for p in items), abs=scale)
    assert lump.mass * lump.centre[1] == pytest.approx(sum(p.mass * p.centre[1] for p in items), abs=scale)


def test_start_length_of_an_actuator_is_the_distance_of_its_ends() -> None:
    assert (
        LinearActuator(foot="ground", head="a", foot_point=(1.0, 2.0), head_point=(4.0, 6.0)).start_length
        == 5.0
    )


def test_pin_between_two_bodies_is_at_one_point() -> None:
    place = pinned("ground", "a", (1.0, 2.0))
    assert (place.first, place.second) == ("ground", "a")
    assert place.first_point == place.second_point == (1.0, 2.0)


@pytest.mark.parametrize("mass", [-1.0, 0.0])
def test_mass_of_zero_or_less_is_refused(mass: float) -> None:
    with pytest.raises(InputError, match=rf"Body\.mass = {mass}: .*allowed: > 0"):
        Body(mass=mass, inertia=1.0, centre=(0.0, 0.0))


def test_negative_mass_of_a_part_is_refused() -> None:
    with pytest.raises(InputError, match=r"Part\.mass = -1\.0: .*allowed: > 0"):
        Part(mass=-1.0, centre=(0.0, 0.0))


def test_a_part_may_be_a_point_mass() -> None:
    assert Part(mass=1.0, centre=(0.0, 0.0)).inertia == 0.0


def test_a_pin_on_an_unknown_body_is_refused() -> None:
    with pytest.raises(InputError, match=r"pins\.p = 'b': no such body; allowed: ground, a"):
        Linkage(bodies={"a": BODY}, pins={"p": pinned("a", "b", (0.0, 0.0))})


def test_an_actuator_on_an_unknown_body_is_refused() -> None:
    actuator = LinearActuator(foot="b", head="a", foot_point=(0.0, 0.0), head_point=(1.0, 0.0))
    with pytest.raises(InputError, match=r"actuators\.c = 'b': no such body; allowed: ground, a"):
        Linkage(bodies={"a": BODY}, actuators={"c": actuator})


def test_a_point_of_an_unknown_body_is_refused() -> None:
    with pytest.raises(InputError, match=r"points\.t = 'b': no such body; allowed: ground, a"):
        Linkage(bodies={"a": BODY}, points={"t": TracePoint(body="b", point=(0.0, 0.0))})


@pytest.mark.parametrize("body", ["b", "ground"])
def test_a_crank_that_does_not_move_is_refused(body: str) -> None:
    with pytest.raises(InputError, match=rf"cranks\.c = '{body}': no such moving body; allowed: a"):
        Linkage(bodies={"a": BODY}, cranks={"c": Crank(body=body)})


@pytest.mark.parametrize("body", ["b", "ground"])
def test_a_slide_of_a_body_that_does_not_move_is_refused(body: str) -> None:
    with pytest.raises(InputError, match=rf"slides\.s = '{body}': no such moving body; allowed: a"):
        Linkage(bodies={"a": BODY}, slides={"s": Slide(body=body, point=(0.0, 0.0))})


def test_a_slide_against_an_unknown_body_is_refused() -> None:
    with pytest.raises(InputError, match=r"slides\.s\.against = 'b': no such body; allowed: ground, a"):
        Linkage(bodies={"a": BODY}, slides={"s": Slide(body="a", point=(0.0, 0.0), against="b")})


def test_a_slide_of_a_body_against_itself_is_refused() -> None:
    with pytest.raises(InputError, match=r"slides\.s = 'a' twice: allowed: two different bodies"):
        Linkage(bodies={"a": BODY}, slides={"s": Slide(body="a", point=(0.0, 0.0), against="a")})


def test_actuators_that_are_not_driven_are_no_driven_parts() -> None:
    ends = {"foot": "ground", "head": "a", "foot_point": (0.0, 0.0), "head_point": (1.0, 0.0)}
    actuators = {"jack": LinearActuator(**ends), "strut": LinearActuator(**ends, driven=False)}
    linkage = Linkage(bodies={"a": BODY}, actuators=actuators, cranks={"c": Crank(body="a")})
    assert linkage.driven == ("jack", "c")


def test_a_machine_has_no_details_unless_it_says_so() -> None:
    @value
    class Plain(Machine):
        def linkage(self) -> Linkage:
            return Linkage(bodies={"a": BODY})

    assert Plain().jacks == {}
    assert Plain().detailed(("actuator",), ()) == Plain().linkage()


def test_a_slide_is_along_x_unless_said_otherwise() -> None:
    assert Slide(body="a", point=(0.0, 0.0)).direction == 0.0


def test_everything_may_be_fixed_to_the_ground() -> None:
    linkage = Linkage(bodies={"a": BODY}, pins={"p": pinned("ground", "a", (0.0, 0.0))})
    assert linkage.pins["p"].first == "ground"


def test_a_linkage_comes_back_from_json() -> None:
    linkage = Linkage(
        bodies={"a": BODY},
        pins={"p": PinPlace(first="ground", second="a", first_point=(0.0, 0.0), second_point=(0.0, 0.1))},
        points={"t": TracePoint(body="a", point=(1.0, 0.0))},
        cranks={"c": Crank(body="a")},
        slides={"s": Slide(body="a", point=(0.0, 1.0), direction=0.3)},
    )
    assert Value.from_data(json.loads(json.dumps(linkage.to_data()))) == linkage


def test_a_machine_without_actuators_takes_any_extension() -> None:
    @value
    class Pendulum(Machine):
        def linkage(self) -> Linkage:
            return Linkage(bodies={"a": BODY}, pins={"p": pinned("ground", "a", (0.0, 1.0))})

    Pendulum().check_extension(-1.0, 1.0)
    assert not Pendulum().linkage().actuators


def test_no_body_is_called_ground() -> None:
    body = Body(mass=1.0, inertia=1.0, centre=(0.0, 0.0))
    with pytest.raises(InputError, match="ground"):
        Linkage(bodies={"ground": body})


def test_a_pin_joins_two_bodies() -> None:
    body = Body(mass=1.0, inertia=1.0, centre=(0.0, 0.0))
    place = PinPlace(first="one", second="one", first_point=(0.0, 0.0), second_point=(0.0, 0.0))
    with pytest.raises(InputError, match=r"pins\.pin = 'one' twice"):
        Linkage(bodies={"one": body}, pins={"pin": place})
