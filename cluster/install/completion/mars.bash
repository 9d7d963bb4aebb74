# Completion for bash. The programs say themselves what they take (--list-options, which is described in
# host/options/command_line.h), so this file knows no option.

# _mars_values VALUE WORD: what may stand where help asks for VALUE and WORD is typed so far.
_mars_values() {
  case $1 in
    FILM) compgen -d -- "$2"; compgen -f -X '!*.json' -- "$2"; compgen -f -X '!*.mars' -- "$2" ;;
    FILE) compgen -f -- "$2" ;;
    DIR) compgen -d -- "$2" ;;
    *'|'*) compgen -W "${1//|/ }" -- "$2" ;;
  esac
}

_mars() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  if [ "$current" = = ]; then current=''
  elif [ "$previous" = = ]; then previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi

  # A program's own lines come first, then those of its commands: the command typed replaces what was found.
  local kind of names value rest program='' command='' options='' commands='' argument='' asked=''
  while IFS=$'\t' read -r kind of names value rest; do
    case $kind in
      command)
        if [ -z "$program" ]; then
          program=$of command=$of
        elif [ "$COMP_CWORD" -gt 1 ] && [ "$of" = "$program ${COMP_WORDS[1]}" ]; then
          command=$of options='' commands='' argument='' asked=''
        elif [ "$command" = "$program" ]; then
          commands+=" ${of#"$program "}"
        fi ;;
      argument) [ "$of" != "$command" ] || argument=$names ;;
      option)
        [ "$of" = "$command" ] || continue
        options+=" ${names//,/ }"
        [[ ",$names," != *",$previous,"* || $value = - ]] || asked=$value ;;
    esac
  done < <("${1/#\~/$HOME}" --list-options 2>/dev/null)

  if [ -z "$asked" ] && [[ $current != -* ]]; then asked=$argument; fi
  case $asked in FILM | FILE | DIR) compopt -o filenames 2>/dev/null ;; esac
  if [ -n "$asked" ]; then mapfile -t COMPREPLY < <(_mars_values "$asked" "$current")
  elif [[ $current = -* ]]; then mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
  fi
}

complete -F _mars mars mars-host mars-cube mars-threads
