#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What changed between two results of izb bench: for every number of their tables in percent, as Markdown.
set -euo pipefail
export LC_ALL=C

usage() {
  cat <<'TEXT'
usage: bench/changes.sh A B

A and B are folders that `izb bench` wrote, or two of their tables (CSV). For each table that both have it prints every
number that differs, the largest change first: what it was in A, what it is in B, and by how many percent of A it is more
or less, or where the numbers are changes in percent themselves (some are below 0) by how many points. Rows are matched by their text columns; where these do not tell the rows apart, by the numbers beside them, too.
Texts, rows, columns and tables that only one has are said, and so is what differs in the conditions: machine, driver,
program, extent and options, as report.json has them. The paper's own numbers are left out.

Exit code 0, whatever changed; 1 where something cannot be read or there is nothing to compare; 2 for wrong usage.
TEXT
}

most_arguments=2
# shellcheck source=bench/arguments.sh
source "$(dirname "${BASH_SOURCE[0]}")/arguments.sh"
if [ $# -ne 2 ]; then
  usage >&2
  exit 2
fi
fail() {
  echo "changes.sh: $1" >&2
  exit 1
}
a=${1%/} b=${2%/}
for path in "$a" "$b"; do
  [ -e "$path" ] || fail "'$path' is not there"
  [ -r "$path" ] || fail "'$path' cannot be read"
done

# conditions FILE: a line for each fact of a report, "SECTION: FACT<tab>VALUE"; the section is empty for those of all.
# It reads the lines of izb's own JSON, in which each string stands alone.
conditions() {
  [ -r "$1" ] || return 0
  awk '
    function text(line) {
      sub(/^ *"/, "", line); sub(/",?$/, "", line)
      gsub(/\\"/, "\"", line); gsub(/\\\\/, "\\", line)
      return line
    }
    /^ "facts": \[$/ || /^   "facts": \[$/ { inside = 1; indent = index($0, "\"") - 1; next }
    inside && index($0, "]") == indent + 1 { inside = 0; next }
    inside && /^ *"/ { if (odd = !odd) name = text($0); else { names[++n] = name; values[n] = text($0); top[n] = indent == 1 } }
    /^   "id": "/ {
      line = $0
      sub(/^ *"id": /, "", line)
      for (i = 1; i <= n; ++i) if (!top[i]) print text(line) ": " names[i] "\t" values[i]
      n = 0
    }
    /^ "sections": \[$/ { for (i = 1; i <= n; ++i) print names[i] "\t" values[i]; n = 0 }
  ' "$1"
}

# different_conditions A B: what differs, but for when and by which words it was measured.
different_conditions() {
  awk -F'\t' '
    FNR == 1 { ++file }
    $1 == "command" || $1 == "written" { next }
    file == 1 { a[$1] = $2; next }
    { b[$1] = $2; order[++n] = $1 }
    END {
      for (i = 1; i <= n; ++i)
        if (order[i] in a && a[order[i]] != b[order[i]])
          printf "- %s differs: %s; now %s\n", order[i], a[order[i]], b[order[i]]
    }' <(conditions "$1"; echo "command") <(conditions "$2"; echo "command")
}

# changes A.csv B.csv
changes() {
  file_a=$1 file_b=$2 awk '
    # RFC 4180: cells[which, row, column], rows[which], columns[which]; row 0 is the header.
    function read_csv(path, which,   text, line, got, i, c, quoted, cell, row, column, length_) {
      text = ""
      while ((got = (getline line < path)) > 0) text = text line "\n"
      if (got < 0) { print "changes.sh: cannot read \"" path "\"" > "/dev/stderr"; failed = 1; exit 1 }
      close(path)
      sub(/^\357\273\277/, "", text)
      quoted = 0; cell = ""; row = 0; column = 0; length_ = length(text)
      for (i = 1; i <= length_; ++i) {
        c = substr(text, i, 1)
        if (quoted) {
          if (c != "\"") cell = cell c
          else if (substr(text, i + 1, 1) == "\"") { cell = cell c; ++i }
          else quoted = 0
        } else if (c == "\"") quoted = 1
        else if (c == "," || c == "\n") {
          cells[which, row, ++column] = cell
          cell = ""
          if (c == ",") continue
          if (!row) columns[which] = column
          if (column != columns[which]) {
            print "changes.sh: \"" path "\" has " column " cells in row " row " and not " columns[which] > "/dev/stderr"
            failed = 1; exit 1
          }
          ++row; column = 0
        } else if (c != "\r") cell = cell c
      }
      if (quoted || row == 0) { print "changes.sh: \"" path "\" is no CSV table" > "/dev/stderr"; failed = 1; exit 1 }
      rows[which] = row - 1
    }
    function is_number(text) { return text ~ /^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?$/ }
    function is_missing(text) { return text == "" || text ~ /^n\/a: / }
    # A column of numbers: what is there, in both, is one.
    function numbers_in(name,   which, row, cell) {
      for (which = 1; which <= 2; ++which)
        for (row = 1; row <= rows[which]; ++row) {
          cell = cells[which, row, place[which, name]]
          if (!is_missing(cell) && !is_number(cell)) return 0
        }
      return 1
    }
    # Percents below 0 are changes themselves, which have no share of one another: points tell them apart.
    function is_change(name,   which, row) {
      if (name !~ / \(%\)$/) return 0
      for (which = 1; which <= 2; ++which)
        for (row = 1; row <= rows[which]; ++row) if (cells[which, row, place[which, name]] ~ /^-/) return 1
      return 0
    }
    function key_of(which, row,   i, key) {
      key = ""
      for (i = 1; i <= keys; ++i) key = key (i > 1 ? ", " : "") cells[which, row, place[which, key_columns[i]]]
      return key
    }
    function unique_keys(   which, row, seen) {
      for (which = 1; which <= 2; ++which) {
        split("", seen)
        for (row = 1; row <= rows[which]; ++row) if (seen[key_of(which, row)]++) return 0
      }
      return 1
    }
    # Further rows of one key get a number.
    function find_keys(which,   row, key, seen) {
      split("", seen)
      for (row = 1; row <= rows[which]; ++row) {
        key = key_of(which, row)
        if (seen[key]++) key = key " (" seen[key] ")"
        key_at[which, row] = key
        row_of[which, key] = row
      }
    }
    function shown(text) { gsub(/[\r\n]+/, " ", text); gsub(/\|/, "\\|", text); return text }
    function value(text) { return is_number(text) ? sprintf("%.6g", text) : shown(text) }
    function add(size, line,   i) {  # the largest first, else in order
      for (i = ++found; i > 1 && sizes[i - 1] < size; --i) { sizes[i] = sizes[i - 1]; lines[i] = lines[i - 1] }
      sizes[i] = size; lines[i] = line
    }
    function only_in(what, which, list) { if (list != "") printf "\n%s only in %s: %s\n", what, which, shown(list) }
    function join(list, item) { return list == "" ? item : list "; " item }
    BEGIN {
      read_csv(ENVIRON["file_a"], 1); read_csv(ENVIRON["file_b"], 2)
      for (which = 1; which <= 2; ++which)
        for (i = 1; i <= columns[which]; ++i) {
          name = cells[which, 0, i]
          for (n = 2; (which, name) in place; ++n) name = cells[which, 0, i] " (" n ")"
          place[which, name] = i
          names[which, i] = name
        }
      for (i = 1; i <= columns[1]; ++i) {
        name = names[1, i]
        if (!((2, name) in place)) { gone = join(gone, name); continue }
        common[++commons] = name
        numeric[name] = numbers_in(name)
        changes_itself[name] = is_change(name)
      }
      for (i = 1; i <= columns[2]; ++i) if (!((1, names[2, i]) in place)) come = join(come, names[2, i])
      # The texts before the first number name the row; those behind it are of what was found.
      for (i = 1; i <= commons && !numeric[common[i]]; ++i) { key_columns[++keys] = common[i]; is_key[common[i]] = 1 }
      for (i = 1; i <= commons && !unique_keys(); ++i)
        if (!is_key[common[i]]) { key_columns[++keys] = common[i]; is_key[common[i]] = 1 }
      find_keys(1); find_keys(2)

      for (row = 1; row <= rows[1]; ++row) {
        key = key_at[1, row]
        if (!((2, key) in row_of)) { gone_rows = join(gone_rows, key); continue }
        for (i = 1; i <= commons; ++i) {
          name = common[i]
          if (is_key[name] || name ~ /, paper( \(|$)/) continue
          a = cells[1, row, place[1, name]]; b = cells[2, row_of[2, key], place[2, name]]
          if (a == b) { ++same; continue }
          size = 1e300; change = "changed"
          if (numeric[name] && is_number(a) && is_number(b)) {
            if (a + 0 == b + 0) { ++same; continue }
            if (changes_itself[name]) {
              size = b - a
              change = sprintf("%+.1f points", size)
              if (size < 0) size = -size
            } else if (a + 0 == 0) change = "was 0"
            else {
              size = 100 * (b - a) / (a < 0 ? -a : a)
              change = sprintf("%+.1f %%", size)
              if (size < 0) size = -size
            }
          }
          add(size, "| " shown(key) " | " shown(name) " | " value(a) " | " value(b) " | " change " |")
        }
      }
      for (row = 1; row <= rows[2]; ++row) if (!((1, key_at[2, row]) in row_of)) come_rows = join(come_rows, key_at[2, row])
      if (found) print "\n| row | column | A | B | change |\n|---|---|---|---|---|"
      for (i = 1; i <= found; ++i) print lines[i]
      if (same) printf "\n%d %s the same.\n", same, same == 1 ? "value is" : "values are"
      only_in("Columns", "A", gone); only_in("Columns", "B", come)
      only_in("Rows", "A", gone_rows); only_in("Rows", "B", come_rows)
    }
    END { if (failed) exit 1 }'
}

echo "Changes from A, \`$1\`, to B, \`$2\`"
if [ ! -d "$a" ] && [ ! -d "$b" ]; then
  changes "$a" "$b"
  exit
fi
if [ ! -d "$a" ] || [ ! -d "$b" ]; then
  fail "one of '$1' and '$2' is a folder, and one is not"
fi

conditions=$(different_conditions "$a/report.json" "$b/report.json")
[ -z "$conditions" ] || printf '\n%s\n' "$conditions"
for folder in "$a" "$b"; do
  [ -r "$folder/report.json" ] || printf '\n- %s has no report.json: on what it was measured is not known\n' "'$folder'"
done
compared=0
for path in "$a"/*.csv; do
  table=$(basename "$path" .csv)
  [ -e "$b/$table.csv" ] || continue
  compared=$((compared + 1))
  printf '\n## %s\n' "$table"
  changes "$path" "$b/$table.csv"
done
[ $compared -gt 0 ] || fail "no table is in both '$1' and '$2'"
# only_in WHICH FOLDER OTHER
only_in() {
  local path names=
  for path in "$2"/*.csv; do
    [ -e "$path" ] && [ ! -e "$3/$(basename "$path")" ] && names+="${names:+, }$(basename "$path" .csv)"
  done
  [ -z "$names" ] || printf '\nTables only in %s: %s\n' "$1" "$names"
}
only_in A "$a" "$b"
only_in B "$b" "$a"
