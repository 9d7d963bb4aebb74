# Completion for bash. The programs say themselves what they take (--list-options, which is described in
# host/shell/options/command_line.h), so this file knows no option.

# _mars_values VALUE WORD: candidates for a value that help calls VALUE, where WORD is typed so far; after "KEY=", which
# bash takes for words of their own, $key is that.
_mars_values() {
  case $1 in
    FILM) compgen -d -- "$2"; compgen -f -X '!*.json' -- "$2"; compgen -f -X '!*.mars' -- "$2" ;;
    MODEL) compgen -d -- "$2"; compgen -f -X '!*.json' -- "$2" ;;
    FILE) compgen -f -- "$2" ;;
    DIR) compgen -d -- "$2" ;;
    *'|'*)
      local each
      for each in ${1//|/ }; do [[ $each != "$key"* ]] || compgen -W "${each#"$key"}" -- "$2"; done ;;
  esac
}

_mars() {
  local kind of names value rest name program='' i word
  local -A arguments=() options=() commands=() values=()  # of each command; values: of "COMMAND OPTION"
  while IFS=$'\t' read -r kind of names value rest; do
    case $kind in
      command)
        program=${program:-$of} arguments[$of]='' options[$of]='' commands[$of]=''
        [ "$of" = "$program" ] || commands[${of% *}]+=" ${of##* }" ;;
      argument)
        [[ $value != *'|'* ]] || names=$value${names##*[!.]}
        arguments[$of]+=" $names" ;;
      option)
        options[$of]+=" ${names//,/ }"
        for name in ${names//,/ }; do values["$of $name"]=${value#-}; done ;;
    esac
  done < <("${1/#\~/$HOME}" --list-options 2>/dev/null)
  [ -n "$program" ] || return 0

  # From the words typed before: the command, the number of its arguments, and the values that an option still needs.
  local command=$program given=0 asked=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [ "$word" = = ]; then continue
    elif [ ${#asked[@]} -gt 0 ]; then asked=("${asked[@]:1}")
    elif [[ $word = -* ]]; then read -r -a asked <<< "${values["$command $word"]-}"
    elif [[ " ${commands[$command]} " = *" $word "* ]]; then command+=" $word" given=0
    else given=$((given + 1))
    fi
  done

  local current=${COMP_WORDS[COMP_CWORD]} expected=(${arguments[$command]})
  [ "$current" != = ] || current=''
  local key='' at=$((COMP_CWORD - 1))
  [ "${COMP_WORDS[COMP_CWORD]}" != = ] || at=$COMP_CWORD
  [ "${COMP_WORDS[at]}" != = ] || [[ ${COMP_WORDS[at - 1]} = -* ]] || key=${COMP_WORDS[at - 1]}=
  if [ ${#asked[@]} -gt 0 ]; then value=${asked[0]}
  elif [[ $current = -* ]]; then value='' names=${options[$command]}
  else
    [ "$given" -lt ${#expected[@]} ] || [[ ${expected[*]} != *... ]] || given=$((${#expected[@]} - 1))
    value=${expected[given]-} names=${commands[$command]}
    value=${value%...}
  fi
  case $value in FILM | MODEL | FILE | DIR) compopt -o filenames 2>/dev/null ;; esac
  mapfile -t COMPREPLY < <(
    [ ${#asked[@]} -gt 0 ] || compgen -W "$names" -- "$current"
    _mars_values "$value" "$current")
  [ "${COMPREPLY[*]}" = "${COMPREPLY[0]-}" ] && [[ ${COMPREPLY[0]-} = *= ]] && compopt -o nospace 2>/dev/null
  return 0
}

complete -F _mars mars mars-host mars-ranks mars-threads mars-simulated mars-nx
