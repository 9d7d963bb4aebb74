# Fills a manual page's template in with what programs say about their options (--list-options, described in
# host/shell/options/command_line.h):  awk -v doc=DIR -v data=DIR -f manual.awk OPTIONS TEMPLATE
#   @OPTIONS mars render@   the section OPTIONS of a command
#   @COMMANDS mars@         a subsection for each command that has no page of its own
#   @SETTINGS@              a list of the environment variables, without those of NX programs
#   @SETTINGS MARS_NX_@     a list of the environment variables of NX programs
#   @DOC@, @DATA@           where documents and data are installed
# Templates and result are in mdoc(7).
BEGIN { FS = "\t" }

# Escapes text so that mdoc finds no macro in it.
function plain(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  return (text ~ /^[.']/ ? "\\&" : "") text
}

# Puts each sentence on its own line, and the example in quotes.
function help(text,    at, example) {
  at = index(text, "Example: ")
  example = at ? substr(text, at + 9) : ""
  if (at) text = substr(text, 1, at - 1)
  sub(/ +$/, "", text)
  gsub(/\. /, ".\n", text)
  if (text != "") text = plain(text) (text ~ /[.!?]$/ ? "" : ".") "\n"
  return text (example == "" ? "" : "Example:\n.Ql " plain(example) "\n")
}

# "X Y Z" are three values; "a|b" is a choice of one.
function value(name,    i, count, each, text) {
  if (name == "-") return ""
  count = split(name, each, " ")
  for (i = 1; i <= count; i++)
    text = text (gsub(/\|/, " | Cm ", each[i]) ? " Cm " : " Ar ") each[i]
  return text
}

function option(names, type,    i, count, each, line) {
  count = split(names, each, ",")
  for (i = 1; i <= count; i++) line = line (i > 1 ? " , " : "") "Fl " plain(substr(each[i], 2)) value(type)
  return line
}

FILENAME == ARGV[1] && $1 == "command" {
  commands[++command_count] = $2
  purpose[$2] = $3
  within = $2
  sub(/ [^ ]*$/, "", within)
  holds[within]++
}
FILENAME == ARGV[1] && $1 == "argument" {
  synopsis[$2] = synopsis[$2] ($5 == "required" ? " Ar " $3 : " Oo Ar " $3 " Oc")
  items[$2] = items[$2] ".It Ar " $3 "\n" help($6)
}
FILENAME == ARGV[1] && $1 == "option" && $3 !~ /--help/ {
  if ($5 == "required") synopsis[$2] = synopsis[$2] " " option(first($3), $4)
  else optional[$2] = 1
  items[$2] = items[$2] ".It " option($3, $4) "\n" help($6)
}
FILENAME == ARGV[1] && $1 == "setting" && !($2 in known) {
  known[$2] = 1
  set = $2 ~ /^MARS_NX_/ ? "MARS_NX_" : ""
  settings[set] = settings[set] ".It Ev " $2 "\n" help($3)
}
FILENAME == ARGV[1] { next }

function first(names) {
  sub(/,.*/, "", names)
  return names
}

function list(text) { return ".Bl -tag -width Ds\n" text ".El" }

# The commands of a program that have no page of their own.
function subsections(program,    i, name, text) {
  for (i = 1; i <= command_count; i++) {
    name = commands[i]
    if (index(name, program " ") != 1 || name == program " render") continue
    text = text ".Ss " name "\n" synopsis_of(program, name) help(purpose[name])
    if (items[name] != "") text = text list(items[name]) "\n"
  }
  sub(/\n$/, "", text)
  return text
}

# A command as the user types it, with the arguments of its parent commands: "mars animate FILM pose".
function typed(program, name,    parent) {
  parent = name
  sub(/ [^ ]*$/, "", parent)
  return (parent == program ? "" : typed(program, parent) synopsis[parent]) " Cm " substr(name, length(parent) + 2)
}

function synopsis_of(program, name) {
  return ".Nm" typed(program, name) (optional[name] ? " Oo Ar options Oc" : "") synopsis[name] \
         (holds[name] ? " Ar command" : "") "\n.Pp\n"
}

/^@OPTIONS / { gsub(/^@OPTIONS |@$/, ""); print ".Sh OPTIONS\n" list(items[$0]); next }
/^@COMMANDS / { gsub(/^@COMMANDS |@$/, ""); print subsections($0); next }
/^@SETTINGS/ { gsub(/^@SETTINGS ?|@$/, ""); if ($0 in settings) print list(settings[$0]); next }
{ gsub(/@DOC@/, doc); gsub(/@DATA@/, data); print }
