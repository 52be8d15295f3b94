"""The usual mistakes: before a large error is held against a code, what explains it is looked for.

A mistake explains an error if what the reference would look like with it leaves a fifth at most.
"""
