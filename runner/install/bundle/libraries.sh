# Read by `tidemark` and `verify`; $here is the folder of the bundle. Puts those libraries of lib/fallback into the loader's
# path that this system lacks: lib/wanted is linked with all of them, and the loader lists what it cannot find.
missing=$(LD_TRACE_LOADED_OBJECTS=1 "$here/lib/wanted" 2> /dev/null | sed -n 's/^[[:space:]]*\([^ ]*\) => not found.*/\1/p')
for library in $missing; do
    [ ! -d "$here/lib/fallback/$library" ] || LD_LIBRARY_PATH="$here/lib/fallback/$library${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
done
[ -z "$missing" ] || export LD_LIBRARY_PATH
