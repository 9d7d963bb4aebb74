"""Holds every example against its published schema: validate_examples.py SOURCE_FOLDER. 77: cannot be run here."""
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    print("python3-jsonschema is not installed")
    sys.exit(77)

root = pathlib.Path(sys.argv[1])
schemas = {kind: json.loads((root / f"docs/schema/{kind}.schema.json").read_text()) for kind in ("film", "model")}
store = {schema["$id"]: schema for schema in schemas.values()}
broken = 0
for kind, folder in ("film", "examples"), ("model", "examples/models"):
    jsonschema.Draft202012Validator.check_schema(schemas[kind])
    resolver = jsonschema.RefResolver(schemas[kind]["$id"], schemas[kind], store=store)
    validator = jsonschema.Draft202012Validator(schemas[kind], resolver=resolver)
    files = sorted((root / folder).glob("*.json"))
    assert files, folder
    for path in files:
        for error in validator.iter_errors(json.loads(path.read_text())):
            print(f"{path}: {error.json_path}: {error.message[:200]}")
            broken += 1
    assert list(validator.iter_errors({"frame": 1})), "an unknown key passes"
sys.exit(1 if broken else 0)
