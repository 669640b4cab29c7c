"""Trains like a given one but for some keys of its declaration: other tooth counts, inputs, teeth, or anything else."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Self

from geartrain.analysis.train_strength import TrainUnderLoad
from geartrain.errors import Loc, check_choice
from geartrain.train import Train, declare
from geartrain.train.inheritance import merge_parent
from geartrain.train.short_forms import written_out
from geartrain.train.yaml_nodes import node_from_data

if TYPE_CHECKING:
    from geartrain.analysis.train_variants import TrainVariants

_OWN = ("name", "title", "note", "extends", "remove")


def with_changes(declared: Train, changes: Mapping[str, Any]) -> Train:
    """With other values, by the rules of `extends`. What is not changed keeps its place in a file."""

    def place(loc: Loc) -> str:
        return declared.place(*loc)

    merged = merge_parent(node_from_data(declared, marks=place), written_out(node_from_data(changes)))
    kept = {key: getattr(declared, key) for key in _OWN if key in declared.model_fields_set}
    new = {key: value for key, value in merged.plain().items() if key != "remove"}  # it is done
    return declare(kept | new, merged.place_of)


class ChangeableTrain(TrainUnderLoad):
    """A train that gives others of its kind, each with its own declaration; it is never changed itself."""

    def with_teeth(self, counts: Mapping[str, int] | None = None, **more: int) -> Self:
        """The train with other tooth counts on some wheels.

        Parameters
        ----------
        counts : mapping of str to int, optional
            Tooth count by wheel.
        **more : int
            The same for wheels whose names are words of Python.

        Returns
        -------
        GearTrain
            A new one; what is expected of outputs stays as declared.

        Raises
        ------
        QuestionError
            For wheels there are not, and for what is no tooth count.

        Examples
        --------
        >>> import geartrain
        >>> geartrain.load("planetary-24-18-60").with_teeth(s=30, p=15).solve()["carrier"]
        Fraction(1, 3)
        """
        from geartrain.kinematics.formulas import with_counts

        return type(self)(with_counts(self.declaration, {**(counts or {}), **more}))

    def with_inputs(self, speeds: Mapping[str, Any] | None = None, **more: Any) -> Self:
        """The train driven at other speeds, or at other links.

        Parameters
        ----------
        speeds : mapping of str to number or str, optional
            Speed by link, as in a declaration: 2, "1/3", "50 rpm"; in place of all declared inputs.
        **more : number or str
            The same for links whose names are words of Python.

        Returns
        -------
        GearTrain
            A new one; states that declare inputs of their own keep them.

        Raises
        ------
        DeclarationError
            For links there are not, and for what is no speed.

        Examples
        --------
        >>> import geartrain
        >>> geartrain.load("planetary-24-18-60").with_inputs(carrier=2).solve()["sun"]
        Fraction(7, 1)
        """
        return self.with_changes(inputs={**(speeds or {}), **more})

    def with_changes(self, changes: Mapping[str, Any] | None = None, **more: Any) -> Self:
        """The train with other values of any keys of its declaration.

        Parameters
        ----------
        changes : mapping, optional
            Keys of a declaration with their values, laid over this one as by `extends`: entries of `links`, `gears`,
            `outputs` and the like are merged by name, other values replace the old ones, None unsets a key, and
            `remove` takes entries away.
        **more : object
            The same for keys as words of Python.

        Returns
        -------
        GearTrain
            A new one; what is expected of outputs stays as declared.

        Raises
        ------
        DeclarationError
            For changes that a declaration does not allow.

        Examples
        --------
        >>> import geartrain
        >>> train = geartrain.load("planetary-24-18-60-involute")
        >>> [round(float(train.with_changes(friction=mu).driven("carrier", "sun").efficiency), 4) for mu in (0, 0.1)]
        [1.0, 0.9785]
        """
        return type(self)(with_changes(self.declaration, {**(changes or {}), **more}))

    def with_tooth_form(self, form: str | Mapping[str, Any], pair: str | None = None) -> Self:
        """The train with teeth of another form.

        Parameters
        ----------
        form : str or mapping
            A form's name, or what a declaration says under `tooth_form`.
        pair : str, optional
            Of this pair alone; by default of all pairs that declare none of their own.

        Returns
        -------
        GearTrain
            A new one.

        Raises
        ------
        DeclarationError
            For a form there is not, or sizes it cannot have.

        Examples
        --------
        >>> import geartrain
        >>> train = geartrain.load("planetary-24-18-60")
        >>> [mesh.form for mesh in train.with_tooth_form("involute").meshes]
        ['involute', 'involute']
        """
        if pair is None:
            return self.with_changes(tooth_form=form)
        gears = {gear.name: gear for gear in self.declaration.gears}
        check_choice("pair", pair, gears)
        return self.with_changes(
            gears=[gears[pair].model_dump(include={"id", "pair"}, exclude_unset=True) | {"tooth_form": form}]
        )

    def variants(
        self, counts: Mapping[str, Iterable[int]], outputs: Sequence[str] = (), state: str | None = None
    ) -> TrainVariants:
        """Outputs of all trains that have some of these tooth counts: every combination, by exact formulas at once.

        Parameters
        ----------
        counts : mapping of str to iterable of int
            Counts to try, by wheel.
        outputs : sequence of str
            Some outputs; by default all.
        state : str, optional
            A declared state; None only of a train that has none.

        Returns
        -------
        TrainVariants
            A table in float64 with bounds of its errors; `exact` gives fractions.

        Raises
        ------
        QuestionError
            For wheels, outputs or states there are not, and for more than 10^8 combinations.

        Examples
        --------
        >>> import geartrain
        >>> found = geartrain.load("freeth-2021").variants({"b1": range(220, 228)}, ["mars"])
        >>> len(found), found["b1"][:3].tolist(), found.exact(0, "mars") is not None
        (8, [220, 221, 222], True)
        """
        from geartrain.analysis.train_variants import find_variants

        return find_variants(self.declaration, self.declaration.single_state(state), counts, outputs)
