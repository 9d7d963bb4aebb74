# Fills in a manual page of NX's calls with what the C headers declare:  awk -f nx_manual.awk HEADER.h... PAGE
#   @SYNOPSIS@      the prototypes of the calls that the page's NAME lists, in its order
#   @TYPE name@     the definition of a type or a struct
#   @TWINS@         how those calls and their twins fail; the page's list of errors follows
# Pages and result are in mdoc(7).
FILENAME ~ /\.h$/ {
  if ($0 !~ /^(#|extern "C"|}$)/) headers = headers $0 "\n"
  next
}

# Fills in result[name] and arguments[name] of each call.
function read_headers(    count, each, i, name) {
  gsub(/\/\*([^*]|\*+[^*\/])*\*+\//, "", headers)
  gsub(/[ \n]+/, " ", headers)
  count = split(headers, each, ";")
  for (i = 1; i <= count; i++) {
    if (each[i] ~ /typedef/ || !match(each[i], /[a-z_0-9]+\(/)) continue
    name = substr(each[i], RSTART, RLENGTH - 1)
    arguments[name] = substr(each[i], RSTART + RLENGTH)
    sub(/\) *$/, "", arguments[name])
    result[name] = tidy(substr(each[i], 1, RSTART - 1))
  }
}

# C as mdoc's own pages write it, with the star at the name.
function tidy(text) {
  gsub(/^ +| +$/, "", text)
  gsub(/\* /, "*", text)
  while (match(text, /[a-z]\*/)) text = substr(text, 1, RSTART) " " substr(text, RSTART + 1)
  return text
}

function prototype(name,    count, each, i, depth, letter, argument) {
  if (!(name in result)) {
    print "nx_manual.awk: no header declares " name > "/dev/stderr"
    exit failed = 1
  }
  print ".Ft", result[name]
  print ".Fo", name
  count = length(arguments[name])
  for (i = 1; i <= count + 1; i++) {
    letter = i <= count ? substr(arguments[name], i, 1) : ","
    if (letter == "(") depth++
    if (letter == ")") depth--
    if (letter == "," && depth == 0) {
      print ".Fa \"" tidy(argument) "\""
      argument = ""
    } else {
      argument = argument letter
    }
  }
  print ".Fc"
}

# A struct has a line for each member.
function definition(name,    text) {
  if (!match(headers, "typedef [^;{(]*(\\(\\*" name "\\)\\([^)]*\\)|\\{[^}]*\\} " name ");") &&
      !match(headers, "struct " name " \\{[^}]*\\};")) {
    print "nx_manual.awk: no header defines " name > "/dev/stderr"
    exit failed = 1
  }
  text = tidy(substr(headers, RSTART, RLENGTH))
  if (text ~ /\{/) {
    gsub(/[{;] /, "&\n  ", text)
    sub(/\n *}/, "\n}", text)
    gsub(/ \n/, "\n", text)
    print ".Bd -literal\n" text "\n.Ed"
  } else {
    print ".Vt \"" text "\""
  }
  print ".Pp"
}

function twins(    i, with) {
  for (i = 1; i <= calls; i++)
    if (("_" call[i]) in result) with[++with[0]] = "_" call[i]
  print "A call that fails prints the reason and ends the program on all nodes."
  print (with[0] == 1 ? "Its twin" : "The twins")
  for (i = 1; i <= with[0]; i++)
    print ".Fn " with[i] (i == with[0] ? "" : i == with[0] - 1 ? "\nand" : " ,")
  print (with[0] == 1 ? "returns" : "return") " 0 or more on success."
  print "On failure " (with[0] == 1 ? "it returns" : "they return") " \\-1 and " (with[0] == 1 ? "sets" : "set")
  print ".Va errno :"
}

FNR == 1 { read_headers() }
/^\.Sh / { section = $2 }
/^\.Nm / && section == "NAME" { call[++calls] = $2 }
/^@SYNOPSIS@$/ { for (i = 1; i <= calls; i++) prototype(call[i]); next }
/^@TYPE / { sub(/@$/, "", $2); definition($2); next }
/^@TWINS@$/ { twins(); next }
{ print }
