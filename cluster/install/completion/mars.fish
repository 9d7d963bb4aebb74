# Completion for fish. The programs say themselves what they take (--list-options, which is described in
# host/options/command_line.h), so this file knows no option.

# What may stand where help asks for a value.
function __mars_values
    switch $argv[1]
        case FILM
            __fish_complete_suffix .mars
            __fish_complete_suffix .json
        case FILE
            __fish_complete_path (commandline -ct)
        case DIR
            __fish_complete_directories (commandline -ct) ''
        case '*|*'
            string split '|' -- $argv[1]
    end
end

function __mars
    set -l words (commandline -opc)
    type -q $words[1]; or return
    set -l program
    set -l command
    set -l options
    set -l commands
    set -l argument
    set -l asked
    for row in ($words[1] --list-options 2>/dev/null)
        set -l fields (string split \t -- $row)
        switch $fields[1]
            case command
                if test -z "$program"
                    set program $fields[2]
                    set command $program
                else if test "$fields[2]" = "$program $words[2]"
                    set command $fields[2]
                    set options
                    set commands
                    set argument
                    set asked
                else if test "$command" = "$program"
                    set -a commands (string replace "$program " '' -- $fields[2])\t$fields[3]
                end
            case argument
                test "$fields[2]" = "$command"; and set argument $fields[3]
            case option
                test "$fields[2]" = "$command"; or continue
                set -l help (string replace -r ' Example: .*' '' -- $fields[6])
                for name in (string split , -- $fields[3])
                    set -a options $name\t$help
                    test "$name" = "$words[-1]"; and test "$fields[4]" != -; and set asked $fields[4]
                end
        end
    end
    if set -q asked[1]
        __mars_values $asked
    else if string match -q -- '-*' (commandline -ct)
        printf '%s\n' $options
    else if set -q commands[1]
        printf '%s\n' $commands
    else
        __mars_values $argument
    end
end

for program in mars mars-host mars-cube mars-threads
    complete -c $program -f -a '(__mars)'
end
