# Sourced by the other scripts, which stand beside it: the folder, a PATH that holds what Debian's packages install
# (also where none is set: `env -i scripts/demo.sh`), and one way to configure.
export PATH="${PATH:+$PATH:}/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# configure_release [-D...]: what stands in an existing build folder stays, so that nothing is compiled twice.
configure_release() {
  cmake --preset release --log-level=NOTICE "$@" >/dev/null
}

# What both uses of the sanitized programs ask of them: two frames of where memory was asked for are enough to begin
# with (thirty take a seventh of the time), and undefined behaviour, which is trapped, is told with its place.
sanitizer_options=malloc_context_size=2:handle_sigill=1

# 1234567 -> 1,234,567
with_commas() {
  printf '%s' "$1" | sed ':a;s/^\([0-9]\+\)\([0-9]\{3\}\)/\1,\2/;ta'
}
