"""The option ``--exact`` of ``synergrip plan``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from synergrip.cli.beside import aside

if TYPE_CHECKING:
    from synergrip.planning.outcome import Outcome


def proven(outcome: Outcome, document: dict[str, Any]) -> tuple[str, dict[str, Any] | None]:
    """Return the line that an exact proof adds to the answer's text, and the proof; put its sum into the document."""
    from synergrip.explain.exact.exact_proof import ExactProof, exact_proof
    from synergrip.planning.digest import with_digest
    from synergrip.planning.outcome import Infeasible

    if not isinstance(outcome, Infeasible):
        aside("only a no has an exact proof, so 'proof.json' was not written")
        return "", None
    found = exact_proof(outcome)
    keys: dict[str, Any] = {"sum": None, "problem_sha256": None, "why": None}
    document["certificate"]["exact"] = keys
    if not isinstance(found, ExactProof):
        keys["why"] = found.why
        document.update(with_digest(document))
        return f"\n{found.why}", None
    keys |= {"sum": float(found.sum), "problem_sha256": found.of}
    document.update(with_digest(document))
    line = f"\nproof re-checked in exact arithmetic: sum = {float(found.sum):.4g} < 0; problem SHA-256 {found.of}"
    return line, found.document()
