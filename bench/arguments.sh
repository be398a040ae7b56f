# SPDX-License-Identifier: MIT
# For scripts that take no options, sourced after `usage` is defined: answers --help, and refuses options and more than
# $most_arguments (1).
case ${1:-} in
  -h | --help)
    usage
    exit 0
    ;;
  -*)
    usage >&2
    exit 2
    ;;
esac
if [ $# -gt "${most_arguments:-1}" ]; then
  usage >&2
  exit 2
fi
