# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas of entries: + - * / ^, parentheses, numbers, pi, inf, functions of one argument, and x, y, r, v."""
import ast
import math
import operator

FUNCTIONS = {"ln": math.log, "log10": math.log10, "exp": math.exp, "sqrt": math.sqrt, "abs": abs, "sin": math.sin,
             "cos": math.cos}
OPERATORS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
             ast.Pow: math.pow}
SIGNS = {ast.USub: operator.neg, ast.UAdd: operator.pos}
CONSTANTS = {"pi": math.pi, "inf": math.inf}
VARIABLES = "x", "y", "r", "v"


def _compile(node):
    """The node as a function of the variables."""
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        return lambda at: float(node.value)
    if isinstance(node, ast.Name) and node.id in CONSTANTS:
        return lambda at: CONSTANTS[node.id]
    if isinstance(node, ast.Name) and node.id in VARIABLES:
        return lambda at: at[node.id]
    if isinstance(node, ast.UnaryOp) and type(node.op) in SIGNS:
        sign, of = SIGNS[type(node.op)], _compile(node.operand)
        return lambda at: sign(of(at))
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        operation, left, right = OPERATORS[type(node.op)], _compile(node.left), _compile(node.right)
        return lambda at: operation(left(at), right(at))
    if (isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS
            and len(node.args) == 1 and not node.keywords):
        function, argument = FUNCTIONS[node.func.id], _compile(node.args[0])
        return lambda at: function(argument(at))
    raise ValueError(f"'{ast.unparse(node)}' is not known; there are {', '.join([*VARIABLES, *CONSTANTS, *FUNCTIONS])}")


class Formula:
    """Formula("y/(1+y)")(y=1) is 0.5; NaN where it is undefined. Raises ValueError."""

    def __init__(self, text):
        try:
            self._value = _compile(ast.parse(text.replace("^", "**"), mode="eval").body)
        except (SyntaxError, RecursionError, MemoryError):
            raise ValueError(f"'{text}' is no formula") from None

    def __call__(self, **at):
        try:
            return self._value({**dict.fromkeys(VARIABLES, math.nan), **at})
        except (ValueError, ZeroDivisionError, OverflowError):
            return math.nan

    def slope(self, variable, **at):
        """Its derivative."""
        here = at[variable]
        step = 1e-5 * (abs(here) or 1)
        above, below = (self(**{**at, variable: here + h}) for h in (step, -step))
        return (above - below) / (2 * step)
