#!/bin/sh
# Tests and measures this machine's device: verify [FOLDER] [--device NAME]. Writes FOLDER/verify.json and FOLDER/index.html.
here=$(dirname "$(readlink -f "$0")")
. "$here/lib/libraries.sh"
TIDEMARK="$here/bin/tidemark" exec "$here/lib/python/bin/python3" -I -S -B "$here/verify.d/tests/bench/verify.py" "$@"
