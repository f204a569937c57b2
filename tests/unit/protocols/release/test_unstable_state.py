"""A balance with a complex pair: its mode, its initial velocity and its linear dynamics."""

from dataclasses import replace

import numpy as np
import pytest

from grainmodes.kernels.damping import Undamped
from grainmodes.kernels.dynamics import Stop
from grainmodes.packing.jacobian import jacobian
from grainmodes.packing.mass_weighted import generalized_mass
from grainmodes.packing.state import nonaffine_motion
from grainmodes.relaxation.dynamics import move
from released import state


def test_the_state_has_the_pair_that_it_says():
    start, _, interaction = state()
    assert start.residual(interaction) < 1e-12
    assert (start.frequency + 1j * start.growth_rate) ** 2 == pytest.approx(start.eigenvalue)
    worse = replace(start, mode=np.roll(start.mode, 1))
    assert worse.residual(interaction) > 0.1


def test_the_initial_velocity_is_along_the_paper_s_vector_and_moves_no_centre():
    """C (27), (28): both columns of [u_r u_i] times the rotation and scaling, added."""
    start, _, _ = state()
    real, imaginary = start.eigenvalue.real, start.eigenvalue.imag
    plane = np.stack([start.mode.real.ravel(), start.mode.imag.ravel()], axis=1)
    columns = plane @ np.array([[real, imaginary], [-imaginary, real]])
    along = columns.sum(axis=1)
    velocity = start.initial_velocity(1e-3)
    cosine = along @ velocity.ravel() / np.linalg.norm(along) / np.linalg.norm(velocity)
    assert cosine == pytest.approx(1.0, abs=1e-12)
    assert np.sqrt((velocity[:, :2] ** 2).sum(axis=1).mean()) == pytest.approx(1e-3)
    assert np.abs(start.packing.mass @ velocity[:, :2]).max() < 1e-15


def test_a_released_state_moves_as_linear_theory_says():
    start, _, interaction = state()
    steps, dt, size = 4000, 0.01, 1e-9
    velocity = start.initial_velocity(size)
    motion = move(start.packing, velocity, interaction, Undamped(), dt, Stop(0.0, steps))
    moved = nonaffine_motion(start.packing, motion.packing)
    omega = start.frequency + 1j * start.growth_rate
    weight = start.eigenvalue.real + start.eigenvalue.imag
    weight += 1j * (start.eigenvalue.imag - start.eigenvalue.real)
    field = weight * start.mode
    scale = size / np.sqrt((field.real[:, :2] ** 2).sum(axis=1).mean())
    expected = scale * (field * np.sin(omega * steps * dt) / omega).real
    assert np.abs(moved - expected).max() < 1e-3 * np.abs(expected).max()


def test_equation_25_needs_the_other_vector_in_its_last_term():
    """J u_i = λ_i u_r + λ_r u_i; printed is λ_r u_r."""
    start, _, interaction = state()
    matrix = jacobian(start.packing, interaction)
    mass = generalized_mass(start.packing.mass).ravel()
    u_r, u_i = start.mode.real.ravel(), start.mode.imag.ravel()
    found, value = matrix @ u_i / mass, start.eigenvalue
    right, printed = (value.imag * u_r + value.real * vector for vector in (u_i, u_r))
    assert np.abs(found - right).max() < 1e-13
    assert np.abs(found - printed).max() > 0.01
