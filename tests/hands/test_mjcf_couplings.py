from pathlib import Path

import mujoco
import numpy as np
import pytest
from mjcf_texts import fingers, plain, with_masses

from synergrip.errors import InputError
from synergrip.hands.bare import bare_hand
from synergrip.hands.hand import Coupling
from synergrip.hands.models.model_file import read_model
from synergrip.hands.synergies.matrix import coupling_map


def read(folder, text):
    path = folder / "hand.xml"
    path.write_text(text, encoding="utf-8")
    return read_model(path)


def refused(folder, text):
    with pytest.raises(InputError) as caught:
        read(folder, text)
    (issue,) = caught.value.issues
    assert Path(issue.file) == folder / "hand.xml"
    return issue


EQUALITIES = {
    "ratio": ('<joint joint1="a" joint2="b" polycoef="0.1 -0.4 0 0 0"/>', 1),
    "two drivers apart": ('<joint joint1="a" joint2="c"/><joint joint1="b" joint2="c" polycoef="0 2 0 0 0"/>', 2),
    "chain": ('<joint joint1="a" joint2="b"/><joint joint1="b" joint2="c" polycoef="0.3 1 0 0 0"/>', 2),
    "locked": ('<joint joint1="a" polycoef="0.3 5 6 0 0"/><joint joint1="b" joint2="a"/>', 2),
    "tendons": ('<tendon tendon1="t" tendon2="u" polycoef="0.02 0.7 0 0 0"/>', 1),
    "tendon held": ('<tendon tendon1="t" polycoef="-0.1 0 0 0 0"/>', 1),
    "said twice": ('<joint joint1="b" joint2="a" polycoef="0 -0.5 0 0 0"/><tendon tendon1="v"/>', 1),
    "each follows the other": ('<joint joint1="a" joint2="b"/><joint joint1="b" joint2="a"/>', 1),
    "switched off": ('<joint joint1="a" joint2="b" active="false"/><weld body1="a" body2="b" active="false"/>', 0),
}  # fmt: skip
TENDONS = """<tendon>
  <fixed name="t"><joint joint="a" coef="2"/><joint joint="s" coef="30"/></fixed>
  <fixed name="u"><joint joint="c" coef="-1.5"/></fixed>
  <fixed name="v"><joint joint="a" coef="1"/><joint joint="b" coef="2"/></fixed>
</tendon>"""
JOINTS = [("a", 'ref="0.2" axis="0 0 1"'), ("b", 'ref="-0.3" axis="0 1 0"'), ("c", 'axis="1 0 0" ref="0.5"'),
          ("s", 'type="slide" axis="1 0 0" ref="0.01"')]  # fmt: skip


@pytest.mark.parametrize(("equalities", "followers"), EQUALITIES.values(), ids=EQUALITIES)
def test_couplings_are_the_places_where_mujoco_finds_no_error(tmp_path, equalities, followers):
    text = fingers(*JOINTS, after=f"<equality>{equalities}</equality>{TENDONS}")
    tree = read(tmp_path, text)
    assert len(tree.couplings) == followers
    model = with_masses(text)
    data = mujoco.MjData(model)
    E, e = coupling_map(tree.moving, tree.couplings)

    def errors(q):
        data.qpos[:] = q
        mujoco.mj_forward(model, data)
        held = data.efc_type[: data.nefc] == mujoco.mjtConstraint.mjCNSTR_EQUALITY
        return data.efc_pos[: data.nefc][held], data.efc_J.reshape(-1, model.nv)[: data.nefc][held]

    rng = np.random.default_rng(0)
    for _ in range(5):
        q = E @ rng.normal(size=4) + e
        error, jacobian = errors(q)
        np.testing.assert_allclose(error, 0, atol=1e-12)
        assert np.linalg.matrix_rank(np.vstack([jacobian, np.zeros(4)])) == followers
        for follower in tree.couplings:
            other = q + np.eye(4)[tree.moving.index(follower)] * 0.1
            assert np.abs(errors(other)[0]).max() > 0.01


def test_joint1_follows_and_a_constant_locks(tmp_path):
    follows, locked = '<joint joint1="b" joint2="a" polycoef="0.1 0.5"/>', '<joint joint1="c" polycoef="0.2"/>'
    tree = read(tmp_path, plain("a", "b", "c", after=f"<equality>{follows}{locked}</equality>"))
    assert tree.couplings == {"b": Coupling({"a": 0.5}, 0.1), "c": Coupling({}, 0.2)}
    tree = read(tmp_path, plain("a", "b", after='<equality><joint joint1="a" joint2="b" polycoef="0 4"/></equality>'))
    assert tree.couplings == {"a": Coupling({"b": 4}, 0)}


def test_a_palm_that_floats_changes_no_coupling(tmp_path):
    text = fingers(*JOINTS, after=f"<equality>{EQUALITIES['chain'][0]}{EQUALITIES['tendons'][0]}</equality>{TENDONS}")
    still, floating = (read(tmp_path, text.replace('"palm">', f'"palm">{free}')) for free in ("", "<freejoint/>"))
    assert still.couplings == floating.couplings
    assert len(still.couplings) == 3


def test_one_motor_on_a_tendon_moves_equal_springs_as_mujoco_balances_them(tmp_path):
    springs = [(name, f'axis="0 0 1" stiffness="1" springref="{0.1 * k}" ref="{0.1 * k}"')
               for k, name in enumerate("abcd")]  # fmt: skip
    coefficients = "".join(f'<joint joint="{name}" coef="{c}"/>' for name, c in {"a": 1, "b": -2, "d": 3}.items())
    equality = '<equality><joint joint1="c" joint2="b" polycoef="0 0.5 0 0 0"/></equality>'
    tendon = f'<tendon><fixed name="t">{coefficients}</fixed></tendon><actuator><motor tendon="t"/></actuator>'
    text = fingers(*springs, after=equality + tendon)
    tree = read(tmp_path, text)
    assert len(tree.couplings) == 3
    hand = bare_hand("h", tree, tree.couplings)
    chosen = hand.synergy_sets["free"]
    model = with_masses(text)
    model.opt.gravity[:] = 0
    data = mujoco.MjData(model)
    data.qpos[:] = chosen.S @ [0.7] + chosen.offset
    mujoco.mj_forward(model, data)
    held = data.efc_J.reshape(-1, 4)[: data.nefc]
    assert np.abs(data.efc_pos[: data.nefc]).max() < 1e-12
    moment = np.zeros((1, 4))
    mujoco.mju_sparse2dense(moment, data.actuator_moment, data.moment_rownnz, data.moment_rowadr, data.moment_colind)
    forces = np.vstack([held, moment]).T
    needed = -data.qfrc_passive
    assert np.linalg.norm(needed) > 0.1
    np.testing.assert_allclose(forces @ np.linalg.lstsq(forces, needed, rcond=None)[0], needed, atol=1e-12)


def test_a_tendon_without_a_motor_or_with_a_motor_for_each_joint_couples_nothing(tmp_path):
    tendon = '<tendon><fixed name="t"><joint joint="a" coef="1"/><joint joint="b" coef="2"/></fixed></tendon>'
    motors = '<actuator><motor tendon="t"/><motor joint="b"/></actuator>'
    assert read(tmp_path, plain("a", "b", after=tendon)).couplings == {}
    assert read(tmp_path, plain("a", "b", after=tendon + motors)).couplings == {}
    driven = read(tmp_path, plain("a", "b", after=tendon + motors.replace('<motor joint="b"/>', "")))
    assert driven.couplings == {"b": Coupling({"a": 2.0}, 0.0)}


LOOP = '<equality>\n<{} body1="a" body2="b" anchor="0 0 1"/></equality>'


@pytest.mark.parametrize("kind", ["connect", "weld"])
def test_a_closed_loop_is_refused(tmp_path, kind):
    issue = refused(tmp_path, plain("a", "b", after=LOOP.format(kind)))
    assert f"<{kind}> closes a loop between 'a' and 'b'" in issue.message
    assert issue.line == 3
    text = """<mujoco><worldbody><body name="p"><body name="a"><joint/><site name="s"/></body><site name="t"/></body>
      </worldbody><equality><connect site1="s" site2="t"/></equality></mujoco>"""
    assert "closes a loop between 'a' and 'p'" in refused(tmp_path, text).message


def test_a_weld_of_what_stands_still_anyway_is_no_loop(tmp_path):
    text = """<mujoco><worldbody><body name="m" mocap="true"/><body name="p"><freejoint/><body name="f"><joint/></body>
      </body></worldbody><equality><weld body1="m" body2="p"/></equality></mujoco>"""
    assert read(tmp_path, text).moving == ("f",)


CONTRADICTIONS = [
    ('<joint joint1="a" joint2="b"/>\n<joint joint1="b" joint2="a" polycoef="0.1 1 0 0 0"/>', "contradicts", (3, 4)),
    ('<joint joint1="a" joint2="a" polycoef="0.1 1 0 0 0"/>', "element 'a' is repeated", (3,)),
    ('<tendon tendon1="t" tendon2="u" polycoef="0.1 1 0 0 0"/>', "contradicts", (3,)),
    ('<joint joint1="a" joint2="b"/><joint joint1="a" joint2="b" polycoef="0 1.0000001"/>', "nearly repeat", (1,)),
    ('<joint joint1="a" joint2="b" polycoef="0 1 0.1 0 0"/>', "polycoef is not linear", (3,)),
    ('<tendon tendon1="rope"/>', "not linear in the joints", (3,)),
]  # fmt: skip


@pytest.mark.parametrize(("equalities", "fragment", "lines"), CONTRADICTIONS)
def test_relations_that_cannot_be_are_refused(tmp_path, equalities, fragment, lines):
    rope = '<spatial name="rope"><site site="s"/><site site="u"/></spatial>'
    same = "".join(f'<fixed name="{name}"><joint joint="a" coef="1"/></fixed>' for name in "tu")
    after = f"<equality>\n{equalities}</equality><tendon>{rope}{same}</tendon>"
    text = plain("a", "b", after=after)
    text = text.replace('"palm">', '"palm"><site name="s" pos="1 0 0"/>').replace(
        'name="b">', 'name="b"><site name="u" pos="0 1 0"/>', 1
    )
    issue = refused(tmp_path, text)
    assert fragment in issue.message
    assert issue.line in lines


def test_a_motor_that_pulls_at_hinges_and_slides_needs_an_equality(tmp_path):
    text = fingers(
        ("a", 'axis="0 0 1"'),
        ("s", 'type="slide" axis="0 0 1"'),
        after="""<tendon><fixed name="t">
      <joint joint="a" coef="1"/><joint joint="s" coef="1"/></fixed></tendon>
      <actuator><motor tendon="t"/></actuator>""",
    )
    assert "pulls at hinges and slides ('a', 's')" in refused(tmp_path, text).message
