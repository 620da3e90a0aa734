# SPDX-License-Identifier: MIT
"""The stub says what the module has: same names, same arguments; everything has a docstring."""
import ast
import os
import re
import unittest

import conelight

STUB = os.path.join(os.path.dirname(conelight.__file__), "__init__.pyi")
# What the stub has beside the module: names of types.
TYPES = {"Floats", "Vector3", "Vector4", "Value", "Path", "Component", "AlphaMode", "LightType", "ErrorMap",
         "SettingDescription", "Surfaces", "Probes"}


def members(body):
    """Name -> node of what a body of the stub declares."""
    found = {}
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = node
        elif isinstance(node, ast.Assign):
            found[node.targets[0].id] = node
    return found


def public(thing):
    return {name for name in vars(thing) if not name.startswith("_")}


def is_property(node):
    return isinstance(node, ast.AnnAssign) or any(
        isinstance(mark, ast.Name) and mark.id == "property" for mark in node.decorator_list)


class Stub(unittest.TestCase):
    def setUp(self):
        with open(STUB, encoding="utf-8") as file:
            self.declared = members(ast.parse(file.read()).body)

    def classes(self):
        for name, node in self.declared.items():
            if isinstance(node, ast.ClassDef) and name not in TYPES | {"Error"}:
                yield getattr(conelight, name), members(node.body)

    def test_names_of_the_module(self):
        self.assertEqual({name for name in self.declared if not name.startswith("_")} - TYPES, public(conelight))
        self.assertEqual(conelight.__version__.count("."), 2)

    def test_names_of_classes(self):
        for thing, declared in self.classes():
            self.assertEqual({name for name in declared if not name.startswith("_")}, public(thing), thing)

    def test_properties_that_can_be_set(self):
        for thing, declared in self.classes():
            for name, node in declared.items():
                if not name.startswith("_") and is_property(node):
                    self.assertIsInstance(vars(thing)[name], property, name)
                    self.assertEqual(vars(thing)[name].fset is not None, isinstance(node, ast.AnnAssign), name)

    def check_arguments(self, where, node, doc):
        """The docstring's first line is the signature; what it leaves to **kwargs is named in the text."""
        signature, _, text = doc.partition("\n")
        arguments = [one.arg for one in (*node.args.args, *node.args.kwonlyargs) if one.arg != "self"]
        defaults = dict(zip([one.arg for one in node.args.args][::-1], node.args.defaults[::-1], strict=False))
        plain = re.findall(r"(?:\(|, )(\w+): ", signature)
        plain = [name for name in plain if name != "self"]
        if "**kwargs" in signature:
            self.assertEqual(arguments[:len(plain)], plain, where)
            for name in arguments[len(plain):]:
                attributes = re.search(r"attributes of (\w+)", text)
                known = attributes and name in vars(getattr(conelight, attributes[1]))
                self.assertTrue(known or re.search(rf"\b{name}\b", text), f"{where}: {name}")
        else:
            self.assertEqual(arguments, plain, where)
        for name in plain:
            is_optional = re.search(rf"\b{name}: [^,()]*(?:\[[^\]]*\])?[^,()]* = ", signature) is not None
            keyword = name in [one.arg for one in node.args.kwonlyargs]
            self.assertEqual(is_optional, keyword or name in defaults, f"{where}: default of {name}")

    def test_arguments(self):
        for name, node in self.declared.items():
            if isinstance(node, ast.FunctionDef):
                self.check_arguments(name, node, getattr(conelight, name).__doc__)
        for thing, declared in self.classes():
            for name, node in declared.items():
                if isinstance(node, ast.FunctionDef) and not is_property(node) and not name.startswith("_"):
                    self.check_arguments(f"{thing.__name__}.{name}", node, vars(thing)[name].__doc__
                                         if not isinstance(vars(thing)[name], staticmethod)
                                         else vars(thing)[name].__func__.__doc__)

    def test_everything_is_documented(self):
        for thing, declared in self.classes():
            self.assertTrue(thing.__doc__, thing)
            for name in declared:
                if not name.startswith("_"):
                    doc = getattr(thing, name).__doc__ or ""
                    text = doc.partition("\n")[2] if re.match(rf"{name}\(", doc) else doc
                    self.assertTrue(text.strip(), f"{thing.__name__}.{name} has no docstring")


if __name__ == "__main__":
    unittest.main()
