// Light or dark, before anything is drawn: as the page around is switched, else as the system is.

{
  const own = document.documentElement, system = matchMedia("(prefers-color-scheme: dark)");
  let around = null;
  try { around = window.frameElement?.ownerDocument.documentElement ?? null; } catch { /* of another origin */ }
  const follow = () => { own.dataset.theme = ["light", "dark"].find(name => name === around?.dataset.theme) ?? (system.matches ? "dark" : "light"); };
  system.addEventListener("change", follow);
  if (around) new MutationObserver(follow).observe(around, {attributeFilter: ["data-theme"]});
  follow();
  own.classList.toggle("framed", window !== window.parent);
}
