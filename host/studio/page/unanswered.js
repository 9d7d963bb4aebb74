// Places and boxes that hands committed and the studio's project does not show yet. Who writes one number after another
// is faster than a far studio: an answer to the first must not take the second away.

const kMembers = ["place", "sbb"];
const kPatience = 5000;  // ms, after which the studio's word counts

export class Unanswered {
  #changes = [];  // {joint, actor, member, value, until}, in their order

  // Shown in `state` at once.
  add({commands = []}, state) {
    for (const [program, verb, joint, ...options] of commands) {
      const shown = program === "model" && verb === "set" && state.joint(joint, state.selected.actor);
      for (const member of shown ? kMembers : []) {
        const value = valueOf(member, options);
        if (!value) continue;
        shown[member] = value;
        this.#changes.push({joint, actor: state.selected.actor, member, value, until: performance.now() + kPatience});
      }
    }
  }

  forget() { this.#changes = []; }

  // The studio's project with what it does not know yet.
  over(project) {
    const now = performance.now();
    this.#changes = this.#changes.filter(({until}) => until > now);
    for (const joint of project.actors.flatMap((actor) => actor.joints.map((each) => ({actor: actor.name, each}))))
      for (const member of kMembers) this.#show(joint, member);
    return project;
  }

  #show({actor, each}, member) {
    const own = this.#changes.filter((change) => change.actor === actor && change.joint === each.name && change.member === member);
    if (own.length === 0) return;
    const answered = own.findLastIndex(({value}) => same(value, each[member]));
    this.#changes = this.#changes.filter((change) => !own.slice(0, answered + 1).includes(change));
    if (answered < own.length - 1) each[member] = own.at(-1).value;
  }
}

// "--place 1 2 3", "--sbb 0 0 0 1 1 1" as the project shows them.
function valueOf(member, options) {
  const at = options.indexOf(`--${member}`) + 1;
  const corner = (from) => options.slice(at + from, at + from + 3).map(Number);
  if (at === 0) return null;
  return member === "sbb" ? [corner(0), corner(3)] : corner(0);
}

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
