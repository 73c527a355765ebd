#!/bin/sh
# Starts Tidemark from this folder; a link to this file works, too.
here=$(dirname "$(readlink -f "$0")")
. "$here/lib/libraries.sh"
exec "$here/bin/tidemark" "$@"
